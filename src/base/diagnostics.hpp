// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace engrane {

/// A place in a deck: a file of a SourceMap, a line and a column (both from 1), and how many columns it spans.
struct Location {
  int file = -1;  ///< index into SourceMap, or -1: no place in particular
  int line = 0;
  int column = 0;
  int length = 1;

  bool known() const { return file >= 0; }
};

/// The texts a deck was read from, kept so that a message can show the offending line. Texts stay where they are while files
/// are added and while the map is moved.
class SourceMap {
 public:
  /// Adds a file and returns its index. `included_from` is the INPUT record that named it. Of a foreign file, one that may hold
  /// what its reader has no business with, messages name places and show no lines.
  int add(std::string path, std::string text, Location included_from = {}, bool foreign = false);

  const std::string& path(int file) const { return files_[static_cast<std::size_t>(file)].path; }
  const std::string& text(int file) const { return files_[static_cast<std::size_t>(file)].text; }
  Location included_from(int file) const { return files_[static_cast<std::size_t>(file)].included_from; }
  bool foreign(int file) const { return files_[static_cast<std::size_t>(file)].foreign; }
  int size() const { return static_cast<int>(files_.size()); }

  /// One line without its end-of-line characters; empty when the line does not exist.
  std::string_view line(int file, int number) const;
  int line_count(int file) const;

 private:
  struct File {
    std::string path;
    std::string text;
    Location included_from;
    bool foreign = false;
    std::vector<std::size_t> line_starts;
  };
  std::deque<File> files_;
};

enum class Severity { warning, error };

/// What the user did wrong and what would be right. Never used for our own faults: those assert.
struct Diagnostic {
  Severity severity = Severity::error;
  Location location;
  std::string message;
  std::string hint;  ///< the cure ("did you mean …", "give …"); may be empty
  std::string_view missing_from =
      {};           ///< of something that was looked for in vain: the command that declares such things, `.NOE`
  int repeats = 0;  ///< how often the same was met again
};

/// Collects everything that is wrong with a deck, so that one run reports all of it.
class Diagnostics {
 public:
  void error(Location where, std::string message, std::string hint = {});
  void warning(Location where, std::string message, std::string hint = {});
  /// A warning that is given once for all of its kind, where it is met first, with the number of others.
  void warning_once(const std::string& kind, Location where, std::string message, std::string hint = {});
  /// The error that something does not exist. `declared_by` is the command whose records are such things, a literal.
  void missing(std::string_view declared_by, Location where, std::string message, std::string hint = {});
  void add(Diagnostic diagnostic);

  bool has_errors() const { return errors_ > 0; }
  int errors() const { return errors_; }
  int warnings() const { return static_cast<int>(all_.size()) - errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// Prints `file:line:column: error: …` with the line, a caret and the include chain, in deck order.
  void print(std::ostream& out, const SourceMap& sources) const;

 private:
  std::vector<Diagnostic> all_;
  std::map<std::string, std::size_t> kinds_;  ///< of warning_once(): which of all
  int errors_ = 0;
};

/// The candidate nearest to `word` (case-insensitive edit distance), or empty when none is near enough to suggest.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace engrane
