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

/// A position in a deck: file (index into a SourceMap), line and column (both from 1), and the number of columns it spans.
struct Location {
  int file = -1;  ///< index into SourceMap, or -1: no particular position
  int line = 0;
  int column = 0;
  int length = 1;

  bool known() const { return file >= 0; }
};

/// The source texts of a deck, kept so that a message can show the offending line. Texts keep their addresses when files are
/// added and when the map is moved.
class SourceMap {
 public:
  /// Adds a file and returns its index. `included_from` is the INPUT record that named it. `foreign`: the file may hold data
  /// its reader must not see, so messages give positions in it but never show its lines.
  int add(std::string path, std::string text, Location included_from = {}, bool foreign = false);

  const std::string& path(int file) const { return files_[static_cast<std::size_t>(file)].path; }
  const std::string& text(int file) const { return files_[static_cast<std::size_t>(file)].text; }
  Location included_from(int file) const { return files_[static_cast<std::size_t>(file)].included_from; }
  bool foreign(int file) const { return files_[static_cast<std::size_t>(file)].foreign; }
  int size() const { return static_cast<int>(files_.size()); }

  /// One line without its end-of-line characters; empty if there is no such line.
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

/// A fault in the user's input, and how to correct it. Never used for faults of the program itself: those assert.
struct Diagnostic {
  Severity severity = Severity::error;
  Location location;
  std::string message;
  std::string hint;                    ///< the remedy ("did you mean …", "give …"); may be empty
  std::string_view missing_from = {};  ///< for a failed look-up: the command that declares such objects, `.NOE`
  int repeats = 0;                     ///< number of further occurrences of the same diagnostic
};

/// Collects all faults of a deck, so that one run reports all of them.
class Diagnostics {
 public:
  void error(Location where, std::string message, std::string hint = {});
  void warning(Location where, std::string message, std::string hint = {});
  /// Issues one warning per `kind`, at its first occurrence; further occurrences are only counted.
  void warning_once(const std::string& kind, Location where, std::string message, std::string hint = {});
  /// Error: the object named does not exist. `declared_by` is the command that declares such objects; it must be a string
  /// literal.
  void missing(std::string_view declared_by, Location where, std::string message, std::string hint = {});
  void add(Diagnostic diagnostic);

  bool has_errors() const { return errors_ > 0; }
  int errors() const { return errors_; }
  int warnings() const { return static_cast<int>(all_.size()) - errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// Prints `file:line:column: error: …` with the source line, a caret and the include chain, in deck order.
  void print(std::ostream& out, const SourceMap& sources) const;

 private:
  std::vector<Diagnostic> all_;
  std::map<std::string, std::size_t> kinds_;  ///< warning_once(): index into all_ by kind
  int errors_ = 0;
};

/// Returns the candidate nearest to `word` (case-insensitive edit distance), or an empty string if none is near enough to
/// suggest.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace engrane
