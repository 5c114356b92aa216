// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

namespace engrane::output {

/// Tells a waiting user how far a run is: on a terminal one line that is written over, elsewhere a line every tenth of the
/// run or every half minute, whichever comes first (but no sooner than a second after the last). To standard error, so that
/// standard output stays clean.
class Progress {
 public:
  enum class Style : unsigned char { terminal, lines, silent };
  /// The style that suits standard error.
  static Style suitable();

  /// From `start` to `end` of `.SUB`.
  Progress(double start, double end, Style style = suitable());
  /// The same on any stream and clock (seconds), for tests.
  Progress(double start, double end, Style style, std::ostream& out, std::function<double()> clock);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What stands before each line, where it is not the run itself.
  void label(std::string text) { label_ = std::move(text); }
  /// After each accepted step: the time reached, the step's length and how many steps there have been.
  void update(double time, double step, long steps);
  /// Prints whole lines of text without mixing them with the progress line.
  void note(const std::string& text);
  /// Ends the progress line. The destructor does it too.
  void finish();

 private:
  std::string line(double time, double step, long steps, double now) const;
  void clear();

  std::string label_;
  double start_, end_;
  Style style_;
  std::ostream& out_;
  std::function<double()> clock_;
  double began_;
  double last_shown_;
  int last_tenth_ = 0;
  double rate_since_ = 0;  ///< steps per second are those of the last seconds, not of the whole run
  long rate_steps_ = 0;
  double rate_ = 0;
  std::size_t width_ = 0;  ///< of the line on the terminal; 0 when there is none
};

/// `3 s`, `4 min 05 s`, `2 h 13 min`.
std::string duration_text(double seconds);

}  // namespace engrane::output
