// SPDX-License-Identifier: BSD-3-Clause
#include "base/diagnostics.hpp"

#include <algorithm>
#include <ostream>
#include <utility>

#include "base/foreign.hpp"
#include "base/text.hpp"

namespace engrane {

int SourceMap::add(std::string path, std::string text, Location included_from, bool foreign) {
  std::vector<std::size_t> starts;
  starts.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
  if (!text.empty()) starts.push_back(0);
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '\n') starts.push_back(i + 1);
  files_.push_back({std::move(path), std::move(text), included_from, foreign, std::move(starts)});
  return size() - 1;
}

std::string_view SourceMap::line(int file, int number) const {
  if (file < 0 || file >= size() || number < 1) return {};
  const File& source = files_[static_cast<std::size_t>(file)];
  const auto index = static_cast<std::size_t>(number - 1);
  if (index >= source.line_starts.size()) return {};
  const std::size_t start = source.line_starts[index];
  const std::size_t end = std::min(source.text.find('\n', start), source.text.size());
  std::string_view line = std::string_view(source.text).substr(start, end - start);
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

int SourceMap::line_count(int file) const { return static_cast<int>(files_[static_cast<std::size_t>(file)].line_starts.size()); }

void Diagnostics::error(Location where, std::string message, std::string hint) {
  add({Severity::error, where, std::move(message), std::move(hint)});
}

void Diagnostics::warning(Location where, std::string message, std::string hint) {
  add({Severity::warning, where, std::move(message), std::move(hint)});
}

void Diagnostics::warning_once(const std::string& kind, Location where, std::string message, std::string hint) {
  const auto [entry, fresh] = kinds_.try_emplace(kind, all_.size());
  if (fresh)
    warning(where, std::move(message), std::move(hint));
  else
    ++all_[entry->second].repeats;
}

void Diagnostics::missing(std::string_view declared_by, Location where, std::string message, std::string hint) {
  add({Severity::error, where, std::move(message), std::move(hint), declared_by});
}

void Diagnostics::add(Diagnostic diagnostic) {
  errors_ += diagnostic.severity == Severity::error;
  all_.push_back(std::move(diagnostic));
}

namespace {

/// Limit on the errors, and on the warnings, that one print shows: a wrong unit in a large mesh must not flood the terminal.
constexpr int most_shown = 100;

/// Number of characters of a source line shown in an excerpt.
constexpr std::size_t excerpt_width = 160;

/// Line and column of each INPUT from the main file down to this position; sorting by them gives deck order.
std::vector<std::pair<int, int>> deck_position(const SourceMap& sources, const Location& where) {
  std::vector<std::pair<int, int>> position;
  for (Location at = where; at.known(); at = sources.included_from(at.file)) position.emplace_back(at.line, at.column);
  std::reverse(position.begin(), position.end());
  return position;
}

/// Prints the offending line with a caret below. Of a line too long for the screen, the part around the caret is shown.
void print_excerpt(std::ostream& out, const SourceMap& sources, const Location& where) {
  const std::string_view line = sources.line(where.file, where.line);
  if (line.empty()) return;
  const std::size_t start = std::min(static_cast<std::size_t>(std::max(where.column - 1, 0)), line.size());
  const std::size_t end = std::min(start + static_cast<std::size_t>(std::max(where.length, 1)), line.size());
  const std::size_t before = character_count(line.substr(0, start));
  std::size_t first = 0;
  if (before > excerpt_width - 40) {  // skip characters at the left, so that the caret stays visible
    std::size_t leave_out = before - (excerpt_width - 80);
    for (; leave_out > 0; --leave_out) first += character_size(line, first);
  }
  std::size_t last = first;
  for (std::size_t shown = 0; last < line.size() && shown < excerpt_width; ++shown) last += character_size(line, last);

  const std::string margin = std::to_string(where.line);
  const std::string blank(margin.size(), ' ');
  const std::string lead = first > 0 ? "..." : "";
  out << "  " << margin << " | " << lead << printable(line.substr(first, last - first)) << (last < line.size() ? "..." : "")
      << '\n';
  const std::size_t indent = lead.size() + character_count(line.substr(first, start - first));
  const std::size_t marked = std::max<std::size_t>(character_count(line.substr(start, std::min(end, last) - start)), 1);
  out << "  " << blank << " | " << std::string(indent, ' ') << '^' << std::string(marked - 1, '~') << '\n';
}

}  // namespace

std::string without_quotes(std::string_view message) {
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t open = std::min(message.find('`', at), message.size());
    text += message.substr(at, open - at);
    const std::size_t close = message.find('`', open + 1);
    if (open == message.size()) break;
    text += "`...`";
    if (close == std::string_view::npos) break;
    at = close + 1;
  }
  return text;
}

namespace {

void print_one(std::ostream& out, const SourceMap& sources, const Diagnostic& diagnostic) {
  const Location& where = diagnostic.location;
  if (where.known()) {
    const std::string_view line = sources.line(where.file, where.line);
    const std::size_t bytes = static_cast<std::size_t>(std::max(where.column - 1, 0));
    out << printable(sources.path(where.file)) << ':' << where.line << ':';
    out << character_count(line.substr(0, std::min(bytes, line.size()))) + 1 << ": ";
  }
  out << (diagnostic.severity == Severity::error ? "error: " : "warning: ")
      << printable(where.known() && sources.foreign(where.file) ? without_quotes(diagnostic.message) : diagnostic.message);
  if (diagnostic.repeats > 0) out << " (and " << counted(static_cast<std::size_t>(diagnostic.repeats), "more time") << ")";
  out << '\n';
  if (!where.known()) {
    if (!diagnostic.hint.empty()) out << "  = " << printable(diagnostic.hint) << '\n';
    return;
  }
  if (!sources.foreign(where.file)) print_excerpt(out, sources, where);
  const std::string blank(std::to_string(where.line).size() + 2, ' ');
  if (!diagnostic.hint.empty()) out << blank << " = " << printable(diagnostic.hint) << '\n';
  for (Location at = sources.included_from(where.file); at.known(); at = sources.included_from(at.file))
    out << blank << " = included from " << printable(sources.path(at.file)) << ':' << at.line << '\n';
}

}  // namespace

void Diagnostics::print(std::ostream& out, const SourceMap& sources) const {
  using Key = std::vector<std::pair<int, int>>;
  std::vector<std::pair<Key, const Diagnostic*>> ordered;
  for (const Diagnostic& diagnostic : all_) ordered.emplace_back(deck_position(sources, diagnostic.location), &diagnostic);
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) {
    // diagnostics without a position come last: they often follow from those that have one
    if (a.first.empty() != b.first.empty()) return b.first.empty();
    return a.first < b.first;
  });
  int shown_errors = 0;
  int shown_warnings = 0;
  for (const auto& [key, diagnostic] : ordered) {
    int& shown = diagnostic->severity == Severity::error ? shown_errors : shown_warnings;
    if (shown == most_shown) continue;
    ++shown;
    print_one(out, sources, *diagnostic);
  }
  if (errors() > shown_errors) out << "and " << counted(static_cast<std::size_t>(errors() - shown_errors), "more error") << '\n';
  if (warnings() > shown_warnings)
    out << "and " << counted(static_cast<std::size_t>(warnings() - shown_warnings), "more warning") << '\n';
}

namespace {

/// Edit distance that counts a transposition of neighbours as one error, the most common typing error.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 40;  // no keyword is longer, and the table above is quadratic
  if (word.size() < 2 || word.size() > longest) return {};
  const std::string wanted = upper(word);
  const std::size_t near_enough = word.size() < 3 ? 0 : word.size() < 6 ? 1 : word.size() < 9 ? 2 : 3;
  std::string best;
  std::size_t best_distance = near_enough + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    const std::size_t distance = edit_distance(wanted, upper(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  if (!best.empty()) return best;
  for (const std::string& candidate : candidates)  // a longer spelling of a keyword, such as FIXED or GEARS
    if (candidate.size() >= 3 && begins_with_word(word, candidate)) return candidate;
  return {};
}

}  // namespace engrane
