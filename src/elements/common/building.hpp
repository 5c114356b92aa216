// SPDX-License-Identifier: BSD-3-Clause
// Checks and conversions that several elements need when they are built from their cards.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/angle.hpp"
#include "model/registry.hpp"

namespace engrane::elements {

inline Vec3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The unit vector along a card's vector. Reports an error at the keyword if the vector is zero.
std::optional<Vec3> unit_vector(const BuildContext& context, std::string_view keyword, const std::array<double, 3>& v);

/// Whether the nodes of the record differ from one another and are not just the ground; otherwise reports an error at `N`.
bool check_nodes(const BuildContext& context, const std::vector<int>& nodes);

/// Looks up the function of NF; `function` is nullptr if `id` is 0 (not given). Returns false, with an error, if there is none.
bool find_function(const BuildContext& context, int id, const Function*& function);

/// Whether two points coincide to the digits given in a deck: to 1e-6 of their largest coordinate.
bool same_place(const Vec3& a, const Vec3& b);

/// A number formatted for messages, to be copied by the user: ten digits, and zero instead of rounding noise.
std::string number(double value);

/// JSON arrays such as `[1, 2, 3]`, for drawings.
std::string json(const Vec3& v);
std::string json(const std::vector<int>& ids);

}  // namespace engrane::elements
