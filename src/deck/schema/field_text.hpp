// SPDX-License-Identifier: BSD-3-Clause
// Texts about a field, shared by help, templates, the manual and canonical decks.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// `2 whole numbers`, `a node`, `3 numbers`, `text`, `a word`, `no value`.
std::string value_kind(const Field& field);

/// The words of a field in deck spelling, keyword first: `ALPHA 20`, `ERR COS 0.004`, `NOM "hub"`. `ranges` allows `1 A 20` for
/// runs of ids.
std::vector<std::string> deck_words(const Field& field, const Field::Values& values, bool ranges);
/// Calls `use` with each of these words in order.
void for_each_deck_word(const Field& field, const Field::Values& values, bool ranges,
                        const std::function<void(std::string_view)>& use);

/// The default in deck spelling, without the keyword; empty if there is none.
std::string default_text(const Schema& schema, const Field& field);

/// Whether all numbers are within the field's range.
bool within_range(const Field& field, const Field::Values& values);

/// Whether there is a default worth showing: not an absent option, an empty list, the reference 0 (none) or a value outside the
/// field's own range, which stands for none.
bool has_default(const Field& field, const Field::Values& defaults);

/// `DT may stand before the value`; empty if the field has no fillers.
std::string filler_text(const Field& field);

/// Appends the values as JSON: `20`, `[1, 2]`, `"SPEED"`, `{"COS": [0.004]}`, `true`.
void append_json(std::string& json, const Field& field, const Field::Values& values);
std::string json_value(const Field& field, const Field::Values& values);

}  // namespace engrane::deck
