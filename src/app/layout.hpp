// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/read.hpp"
#include "observe/observer.hpp"
#include "output/results.hpp"

namespace engrane::app {

/// Everything about a result file that is known before the first step.
output::ResultsLayout results_layout(const Reading& reading, const observe::Observer& observer, std::size_t expected_samples);

/// Returns copies of the observer's current fields in the layout of the results.
output::FrameValues frame_values(const Model& model, const observe::Observer& observer);

}  // namespace engrane::app
