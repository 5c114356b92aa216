// SPDX-License-Identifier: BSD-3-Clause
// What several elements check or convert while they are built from their cards.
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

/// The unit vector along a card's vector; an error at the keyword when it is zero.
std::optional<Vec3> unit_vector(const BuildContext& context, std::string_view keyword, const std::array<double, 3>& v);

/// Does the record name different nodes, not all of them the ground? Otherwise an error at `N`.
bool check_nodes(const BuildContext& context, const std::vector<int>& nodes);

/// The function behind NF: `function` is nullptr when `id` is 0 (none asked for); false, with an error, when it is missing.
bool find_function(const BuildContext& context, int id, const Function*& function);

/// Are two places the same up to the digits a deck gives them with?
bool same_place(const Vec3& a, const Vec3& b);

/// A number as the user should read and may copy it: ten digits, and no rounding noise instead of zero.
std::string number(double value);

/// `[1, 2, 3]` for drawings.
std::string json(const Vec3& v);
std::string json(const std::vector<int>& ids);

}  // namespace engrane::elements
