// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "model/model.hpp"

namespace engrane::app {

/// The model as stored in the results file (docs/format.md, `/model`): elements with their parameters and the shapes that draw
/// them.
std::string model_json(const Model& model);

/// Names and versions of the libraries used, in one line.
std::string library_versions();

}  // namespace engrane::app
