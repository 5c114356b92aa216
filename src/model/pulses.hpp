// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.hpp"

namespace engrane {

/// Instants in (from, to), ascending, that steps should end at so as not to pass over short pulses and steep changes of a
/// function of time: where it begins to change much faster than elsewhere, half-way to another level, farthest from where it
/// began, and where that ends. Only for formulas and for measured curves, whose joints are too many to end steps at: those of
/// all other functions are known. The function is sampled at 16 384 points, and a formula more closely where it changes fast: a
/// pulse shorter than their spacing may be missed, a change to another level is not. Nothing where pulses are no shorter than
/// `long_enough`, which steps cannot miss, or more than a hundred.
std::vector<double> short_pulses(const Function& function, double from, double to, double long_enough);

/// Instants in (from, to), ascending, that steps which follow their error end at: the joints of functions of time
/// (Model::joints) and their short pulses, sampled over the whole run also where it is continued.
std::vector<double> step_ends(const Model& model, double from, double to);

}  // namespace engrane
