// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/read.hpp"
#include "observe/observer.hpp"
#include "output/results.hpp"

namespace engrane::app {

/// What a result file says before the first step.
output::ResultsLayout results_layout(const Reading& reading, const observe::Observer& observer, std::size_t expected_samples);

/// The observer's fields as the results take them; the spans live until it observes again.
output::FrameValues frame_values(const Model& model, const observe::Observer& observer);

}  // namespace engrane::app
