// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane::app {

/// Opens /dev/null in place of standard files that the caller has closed (`>&-`): the next file to be opened, such as the
/// results, would take the number of one and receive what is printed.
void open_standard_files();

/// Writes out what is buffered for standard output, and returns the exit status of the program: `status`, or
/// exit_status::wrong_deck instead of success if part of the output could not be written, which is then reported on standard
/// error. A closed pipe is no error: its reader had enough.
int after_standard_output(int status);

}  // namespace engrane::app
