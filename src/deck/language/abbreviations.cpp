// SPDX-License-Identifier: BSD-3-Clause
#include "deck/language/abbreviations.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace engrane::deck {

namespace {

/// Texts that use each other can grow exponentially: these limits turn that into an error.
constexpr std::size_t longest_text = 100'000;
constexpr std::size_t deepest = 50;
constexpr int most_replacements = 10'000;

/// Expands names in texts, depth first.
class Expansion {
 public:
  Expansion(const Abbreviations& all, const Location& where, Diagnostics& diagnostics)
      : all_(all), where_(where), diagnostics_(diagnostics) {}

  void append(std::string_view name) {
    if (std::find(open_.begin(), open_.end(), name) != open_.end()) {
      std::vector<std::string> chain(open_.begin(), open_.end());
      chain.emplace_back(name);
      return fail("the abbreviation `" + chain.front() + "` uses itself", join(chain, " -> "));
    }
    if (++replacements_ > most_replacements || result.size() > longest_text || open_.size() > deepest)
      return fail("the abbreviation `" + std::string(open_.front()) + "` grows without bounds");
    open_.push_back(name);
    const std::string& text = all_.text(name);
    bool quoted = false;
    for (std::size_t i = 0; i < text.size() && !failed;) {
      if (text[i] == '"') quoted = !quoted;
      const std::string_view inner = !quoted && text[i] == '/' ? all_.longest_at(std::string_view(text).substr(i)) : "";
      if (inner.empty()) {
        result += text[i++];
      } else {
        append(inner);
        i += inner.size();
      }
    }
    open_.pop_back();
  }

  std::string result;
  bool failed = false;

 private:
  void fail(std::string message, std::string hint = {}) {
    if (!failed) diagnostics_.error(where_, std::move(message), std::move(hint));
    failed = true;
  }

  const Abbreviations& all_;
  const Location& where_;
  Diagnostics& diagnostics_;
  std::vector<std::string_view> open_;  ///< names being replaced, outermost first
  int replacements_ = 0;
};

}  // namespace

void Abbreviations::define(std::string name, std::string text) {
  longest_name_ = std::max(longest_name_, name.size());
  if (const auto given = overruling_.find(name); given != overruling_.end()) text = given->second;
  texts_[std::move(name)] = std::move(text);
}

std::string_view Abbreviations::longest_at(std::string_view text) const {
  for (std::size_t size = std::min(longest_name_, text.size()); size > 0; --size)
    if (const auto found = texts_.find(text.substr(0, size)); found != texts_.end()) return found->first;
  return {};
}

std::string Abbreviations::expand(std::string_view name, const Location& where, Diagnostics& diagnostics) const {
  Expansion expansion(*this, where, diagnostics);
  expansion.append(name);
  return expansion.failed ? std::string() : std::move(expansion.result);
}

std::vector<std::string> Abbreviations::names() const {
  std::vector<std::string> result;
  for (const auto& [name, text] : texts_) result.push_back(name);
  return result;
}

}  // namespace engrane::deck
