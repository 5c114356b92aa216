// SPDX-License-Identifier: BSD-3-Clause
// What help, templates, the manual and canonical decks say about a field; one wording for all of them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// `2 whole numbers`, `a node`, `3 numbers`, `text`, `a word`, `no value`.
std::string value_kind(const Field& field);

/// The words of a field as the deck spells them, keyword first: `ALPHA 20`, `ERR COS 0.004`, `NOM "hub"`.
/// `ranges` allows `1 A 20` for runs of ids.
std::vector<std::string> deck_words(const Field& field, const Field::Values& values, bool ranges);
/// Gives these words to `use`, one after the other.
void for_each_deck_word(const Field& field, const Field::Values& values, bool ranges,
                        const std::function<void(std::string_view)>& use);

/// The default as the deck would spell it, without the keyword; empty when there is none.
std::string default_text(const Schema& schema, const Field& field);

/// Is the default worth showing? An absent option, an empty list and the reference 0 (none) are not.
bool has_default(const Field& field, const Field::Values& defaults);

/// Appends the values as JSON: `20`, `[1, 2]`, `"SPEED"`, `{"COS": [0.004]}`, `true`.
void append_json(std::string& json, const Field& field, const Field::Values& values);
std::string json_value(const Field& field, const Field::Values& values);

}  // namespace engrane::deck
