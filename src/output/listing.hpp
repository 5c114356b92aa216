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

/// Heading of a listing.
struct ListingHeader {
  std::string version;    ///< of the program
  std::string libraries;  ///< names and versions
  std::string title;      ///< of the deck
  std::string deck;       ///< its path
  std::string analysis;   ///< `DYNAMIC, CHUNG, rho 0.8`
  std::string machine;    ///< host, number of processes; may be empty
};

/// Counts of what was built from a deck.
struct BuiltSummary {
  struct ElementCount {
    std::string type;
    std::size_t count = 0;
    std::size_t scalars = 0;      ///< total number of the elements' own unknowns
    std::size_t constraints = 0;  ///< total number of their multipliers
  };
  std::vector<ElementCount> elements;
  std::size_t nodes = 0;
  std::size_t translations = 0, rotations = 0;               ///< unknowns of nodes
  std::size_t scalars = 0, multipliers = 0;                  ///< unknowns of elements
  std::size_t prescribed = 0;                                ///< node components fixed by supports, which are no unknowns
  std::size_t nonzeros = 0;                                  ///< of the tangent; 0 if not counted
  std::vector<std::pair<std::string, std::string>> choices;  ///< settings chosen by the program: scale, penalty, tolerance, …
};

/// One Newton iteration. Residuals are relative, as used in the convergence test.
struct IterationRow {
  int step = 0;
  double time = 0;
  int iteration = 0;
  double forces = 0, moments = 0, lengths = 0, angles = 0;  ///< largest relative residuals; constraints: lengths, angles
  double correction = 0;
  std::string blame;  ///< location of the largest residual: `node 57 (rz)`
};

/// Energies at one time. All are absolute values except `error`, the error of the energy balance.
struct EnergyRow {
  double time = 0;
  double kinetic = 0, potential = 0;
  double external_work = 0, dissipated = 0;
  double error = 0;
};

/// Reaction on a supported node, in global components.
struct ReactionRow {
  int node = 0;  ///< id
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
};

/// A body, or the whole model: name, mass, centre of mass, and inertia about the centre in global axes.
struct MassRow {
  std::string name;
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

/// Resultant of everything the ground exerts on the model at one instant, in global components; the moment is about the origin.
struct GroundRow {
  std::string when;  ///< "at the end"
  double time = 0;
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// Resultants of the loads of a mesh and of what the ground exerts on it, at one instant; moments about the origin.
struct LoadRows {
  Vec3 load_force = Vec3::Zero(), load_moment = Vec3::Zero();
  Vec3 reaction_force = Vec3::Zero(), reaction_moment = Vec3::Zero();
  double work = 0;  ///< u·F of the loads
};

/// Breakdown of a run's time, in seconds and in the order of the listing: `assembly`, `factorization`, …
struct TimeSplit {
  std::vector<std::pair<std::string, double>> parts;
  double total = 0;
};

/// Parts of a listing. Each text consists of whole lines; it is empty if there is nothing to report.
std::string listing_header(const ListingHeader& header);
std::string listing_section(const std::string& title);  ///< an underlined title between blank lines
std::string listing_built(const BuiltSummary& summary);
std::string listing_warnings(const Diagnostics& diagnostics, const SourceMap& sources);
/// With `with_heading` false, the rows continue those of an earlier call.
std::string listing_newton(std::span<const IterationRow> rows, bool with_heading);
std::string listing_energies(std::span<const EnergyRow> rows, const UnitSystem& units);
std::string listing_reactions(std::span<const ReactionRow> rows, const UnitSystem& units);
std::string listing_loads(const LoadRows& rows, const UnitSystem& units);
/// Lists at most `most` bodies; the last row is the whole model.
std::string listing_masses(std::span<const MassRow> bodies, const MassRow& model, const UnitSystem& units, std::size_t most);
std::string listing_ground(std::span<const GroundRow> rows, const UnitSystem& units);
/// Lists channels that are not unique. `columns` counts over all tables.
std::string listing_not_unique(const std::vector<HistoryTable>& tables, std::span<const int> columns);
/// Table of the checks with PASS or FAIL, and a line that counts them. The program also prints it at the end of a run.
std::string listing_checks(std::span<const CheckResult> checks);
std::string listing_times(const TimeSplit& split);

/// The file `prefix.lst`. Like the results, it does not replace the listing of a complete result before it is complete itself.
/// Text is flushed as it is written, so the listing of a killed run ends where the run did. Throws OutputError.
class Listing {
 public:
  explicit Listing(OutputName name);
  ~Listing();
  Listing(const Listing&) = delete;
  Listing& operator=(const Listing&) = delete;

  void write(std::string_view text);
  /// Closes the file. If the run is complete, it gets its final name.
  void finish(bool complete);
  const std::string& path() const { return path_; }

 private:
  OutputName name_;
  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace engrane::output
