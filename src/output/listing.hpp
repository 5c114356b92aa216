// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/dimension.hpp"
#include "output/file_names.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

/// What stands at the top of a listing.
struct ListingHeader {
  std::string version;    ///< of the program
  std::string libraries;  ///< names and versions
  std::string title;      ///< of the deck
  std::string deck;       ///< its path
  std::string analysis;   ///< `DYNAMIC, CHUNG, rho 0.8`
  std::string machine;    ///< host, number of processes; may be empty
};

/// What was built from a deck.
struct BuiltSummary {
  struct ElementCount {
    std::string type;
    std::size_t count = 0;
    std::size_t scalars = 0;      ///< own unknowns of all of them
    std::size_t constraints = 0;  ///< multipliers of all of them
  };
  std::vector<ElementCount> elements;
  std::size_t nodes = 0;
  std::size_t translations = 0, rotations = 0;               ///< unknowns of nodes
  std::size_t scalars = 0, multipliers = 0;                  ///< unknowns of elements
  std::size_t prescribed = 0;                                ///< components of nodes that supports hold: no unknowns
  std::size_t nonzeros = 0;                                  ///< of the tangent; 0 when not counted
  std::vector<std::pair<std::string, std::string>> choices;  ///< settled by the program: scale, penalty, tolerance, …
};

/// One Newton iteration. Residuals are relative, as the convergence test sees them.
struct IterationRow {
  int step = 0;
  double time = 0;
  int iteration = 0;
  double forces = 0, moments = 0, lengths = 0, angles = 0;  ///< largest relative residual; of constraints: lengths, angles
  double correction = 0;
  std::string blame;  ///< where the largest residual is: `node 57 (rz)`
};

/// Energies at one time. All but the error are absolute; the error is what the balance fails to close by.
struct EnergyRow {
  double time = 0;
  double kinetic = 0, potential = 0;
  double external_work = 0, dissipated = 0;
  double error = 0;
};

/// Reaction on a supported node, global components.
struct ReactionRow {
  int node = 0;  ///< id
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
};

/// A body, or all of them: what it is called, and its mass, centre and inertia about the centre, global axes.
struct MassRow {
  std::string name;
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

/// The sum of what the ground exerts at one instant, global components; the moment about the origin.
struct GroundRow {
  std::string when;  ///< "at the end"
  double time = 0;
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// Where the time of a run went, seconds, in the order it is to be shown: `assembly`, `factorization`, …
struct TimeSplit {
  std::vector<std::pair<std::string, double>> parts;
  double total = 0;
};

/// Texts of a listing; each is whole lines, and empty when there is nothing to tell.
std::string listing_header(const ListingHeader& header);
std::string listing_section(const std::string& title);  ///< an underlined title between blank lines
std::string listing_built(const BuiltSummary& summary);
std::string listing_warnings(const Diagnostics& diagnostics, const SourceMap& sources);
/// With `with_heading` false the rows go on under those of an earlier call.
std::string listing_newton(std::span<const IterationRow> rows, bool with_heading);
std::string listing_energies(std::span<const EnergyRow> rows, const UnitSystem& units);
std::string listing_reactions(std::span<const ReactionRow> rows, const UnitSystem& units);
/// At most `most` bodies, and the whole model in the last row.
std::string listing_masses(std::span<const MassRow> bodies, const MassRow& model, const UnitSystem& units, std::size_t most);
std::string listing_ground(std::span<const GroundRow> rows, const UnitSystem& units);
/// Channels (columns, counted over all tables) whose values are one choice of many.
std::string listing_not_unique(const std::vector<HistoryTable>& tables, std::span<const int> columns);
/// The table of checks, with PASS or FAIL, and a line that counts them. Also what the program prints at its end.
std::string listing_checks(std::span<const CheckResult> checks);
std::string listing_times(const TimeSplit& split);

/// The file `prefix.lst`. Like the results it keeps out of a complete result's way until it is complete itself. Throws
/// OutputError. Lines reach the file as they are written, so that a killed run's listing ends where the run did.
class Listing {
 public:
  explicit Listing(OutputName name);
  ~Listing();
  Listing(const Listing&) = delete;
  Listing& operator=(const Listing&) = delete;

  void write(std::string_view text);
  /// Closes the file; a complete one takes the final name.
  void finish(bool complete);
  const std::string& path() const { return path_; }

 private:
  OutputName name_;
  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace engrane::output
