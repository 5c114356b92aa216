// SPDX-License-Identifier: BSD-3-Clause
#include "output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

namespace engrane::output {

namespace {

constexpr double terminal_interval = 0.1, line_interval = 30, least_interval = 1, rate_interval = 2;  // seconds

double steady_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

std::string duration_text(double seconds) {
  if (!(seconds < 1e9)) return "long";
  const long s = std::lround(std::max(0.0, seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

Progress::Style Progress::suitable() { return isatty(STDERR_FILENO) ? Style::terminal : Style::lines; }

Progress::Progress(double start, double end, Style style) : Progress(start, end, style, std::cerr, steady_seconds) {}

Progress::Progress(double start, double end, Style style, std::ostream& out, std::function<double()> clock)
    : start_(start), end_(end), style_(style), out_(out), clock_(std::move(clock)), began_(clock_()), last_shown_(began_) {
  rate_since_ = began_;
}

Progress::~Progress() { finish(); }

std::string Progress::line(double time, double step, long steps, double now) const {
  const double part = end_ != start_ ? std::clamp((time - start_) / (end_ - start_), 0.0, 1.0) : 1.0;
  std::string text =
      fmt::format("{}{:3.0f} %  t = {:.6g}  h = {:.3g}  step {}", label_, std::floor(100 * part), time, step, steps);
  const double elapsed = now - began_;
  const double rate = rate_ > 0 ? rate_ : elapsed > 0 ? static_cast<double>(steps) / elapsed : 0;
  if (rate > 0) text += fmt::format("  {:.{}f} steps/s", rate, rate < 10 ? 1 : 0);
  // no estimate too early: it would be useless
  if (part > 0.001 && elapsed > 1 && part < 1) text += "  " + duration_text(elapsed * (1 - part) / part) + " left";
  return text;
}

void Progress::update(double time, double step, long steps) {
  if (style_ == Style::silent) return;
  const double now = clock_();
  if (now - rate_since_ >= rate_interval) {
    rate_ = static_cast<double>(steps - rate_steps_) / (now - rate_since_);
    rate_since_ = now;
    rate_steps_ = steps;
  }
  if (style_ == Style::terminal) {
    if (now - last_shown_ < terminal_interval) return;
    std::string text = line(time, step, steps, now);
    const std::size_t width = text.size();
    if (width < width_) text.append(width_ - width, ' ');
    out_ << '\r' << text << std::flush;
    width_ = width;
    last_shown_ = now;
    return;
  }
  const int tenth = end_ != start_ ? static_cast<int>(10 * std::clamp((time - start_) / (end_ - start_), 0.0, 1.0) + 1e-9) : 10;
  const bool due = (tenth > last_tenth_ && now - last_shown_ >= least_interval) || now - last_shown_ >= line_interval;
  if (!due) return;
  out_ << line(time, step, steps, now) << std::endl;
  last_tenth_ = tenth;
  last_shown_ = now;
}

void Progress::clear() {
  if (width_ == 0) return;
  out_ << '\r' << std::string(width_, ' ') << '\r';
  width_ = 0;
}

void Progress::note(const std::string& text) {
  clear();
  out_ << text;
  if (!text.empty() && text.back() != '\n') out_ << '\n';
  out_ << std::flush;
}

void Progress::finish() {
  clear();
  out_ << std::flush;
}

}  // namespace engrane::output
