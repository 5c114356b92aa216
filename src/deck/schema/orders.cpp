// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/orders.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"

namespace engrane::deck {

namespace {

constexpr std::array all{
    Order{"INPUT", "INPUT \"file\"",
          "reads another file here; the name is relative to the folder of the including file, `.dat` is assumed"},
    Order{"RETURN", "RETURN", "ends that file"},
    Order{"EXIT", "EXIT", "ends the deck, as `.FIN` does"},
    Order{
        "ABRE", "ABRE '/name' 'text'",
        "wherever `/name` stands outside quotes the text is read; the longest name that fits is taken, and a text may use other "
        "names. A name may be given again; the new text holds from there on. In arithmetic, dividing by an abbreviation takes "
        "two "
        "strokes: `(10//name)`. `engrane -D name=text` replaces the text of the deck"},
    Order{"MODE", "MODE LECT n",
          "lines are read up to column n (256 without it); a warning says when text lies beyond, and a number or word cut "
          "in two is an error. Other settings of MODE are skipped with a warning"},
    Order{".FIN", ".FIN", "ends the deck"},
    Order{".DEL", ".DEL.CLM",
          "forgets all records that `.CLM` gave so far, and likewise for any command; `.DEL.*` forgets all records"},
};

std::string_view bare(std::string_view word) { return word.starts_with('.') ? word.substr(1) : word; }

}  // namespace

std::span<const Order> orders() { return all; }

const Order* find_order(std::string_view word) {
  const auto same = [&](const Order& order) { return same_word(bare(order.word), bare(word)); };
  const auto found = std::find_if(all.begin(), all.end(), same);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace engrane::deck
