// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/read.hpp"
#include "observe/observer.hpp"
#include "output/results.hpp"

namespace engrane::app {

/// What a result file says before the first step.
output::ResultsLayout results_layout(const Reading& reading, const observe::Observer& observer, std::size_t expected_samples);

/// Fields as the results take them; the spans live as long as `fields`.
output::FrameValues frame_values(const observe::NodalFields& fields);

}  // namespace engrane::app
