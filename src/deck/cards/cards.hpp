// SPDX-License-Identifier: BSD-3-Clause
// The structs behind the general commands of a deck (`.NOE`, `.CLM`, `.SAM`, …). Elements declare theirs beside their physics.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// `.UNIT SI` or `.UNIT LENGTH f MASS f TIME f`
struct UnitCard {
  bool si = false;
  double length = 1;
  double mass = 1;
  double time = 1;
  bool celsius = false;
};

/// `.TITRE "text"`
struct TitleCard {
  std::string text;
};

/// `.NOE`: `I 12 X 0 0 5` or the row `12 0. 0. 5.`; in the frame of the last `.FRAME` that it names.
struct NodeCard {
  std::array<double, 3> x{0, 0, 0};
  int frame = 0;  ///< 0: the global frame
};

/// `.FRAME I 3 ORIGIN x y z V1 x y z V2 x y z [CYL|SPH]`: origin, first axis, a vector in the half plane of the second.
struct FrameCard {
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> first{1, 0, 0};
  std::array<double, 3> second{0, 1, 0};
  Tagged kind{"CARTESIAN", {}};
};

/// `.SEL GROUP n NOM "x" NOEUDS …`: a named set of nodes or elements.
struct GroupCard {
  int number = 0;
  std::string name;
  Tagged kind{"NODES", {}};         ///< NODES, ELEMENTS, FACES
  bool all = false;                 ///< TOUT
  std::vector<int> ids;             ///< ids and ranges `1 A 20`, expanded by the reader; of FACES pairs of a cell and a face
  std::vector<std::string> united;  ///< UNION: names or numbers of groups
  std::vector<double> box;          ///< BOITE xmin xmax ymin ymax zmin zmax
  std::optional<int> attribute;     ///< MAILLE AT n
};

/// `.MAT I id NOM "steel" BEHA "ELASTIC" YT … NT … M …`; orthotropic with `YT e1 e2 e3 NT n12 n23 n13 G g12 g23 g13`.
struct MaterialCard {
  std::string name;
  std::string behaviour = "ELASTIC";
  std::vector<double> young, poisson, shear, expansion;  ///< one value, or those of three axes; none: not given
  std::optional<double> density;
};

/// Which nodes a record of `.CLM` or `.INI` speaks of.
struct NodeTarget {
  std::vector<int> nodes;           ///< NOEUD ids and ranges
  std::vector<std::string> groups;  ///< GROUP names or numbers
};

/// `.CLM FIX NOEUD n C 1 2 3`
struct FixCard : NodeTarget {
  std::vector<int> components;  ///< 1–3 translations, 4–6 rotations
};

/// `.CLM TEMP GROUP "rim" V 80. [NF f]`: how much warmer nodes are than where bodies are free of stress.
struct TemperatureCard : NodeTarget {
  double rise = 0;
  int function = 0;
};

/// `.CLM DEP NOEUD n C c V value [NF f]`: prescribed displacement (rotation in degrees for C 4–6).
struct DisplacementCard : NodeTarget {
  std::vector<int> components;
  std::vector<double> values;
  int function = 0;
};

/// `.CLM CHA NOEUD n C c V value [NF f]`: force (1–3) or moment (4–6) on a node, fixed in space.
struct LoadCard : NodeTarget {
  std::vector<int> components;
  std::vector<double> values;
  int function = 0;
};

/// `.CLM STRU ACC VAL gx gy gz [NF f]` (`STRUCTURE`): acceleration of gravity on all masses.
struct GravityCard {
  std::array<double, 3> acceleration{0, 0, 0};
  int function = 0;
};

/// `.FCT I id NOM "…" TABLE t y t y … | SINUS … | RAMP … | STEP … | EXPR "…"`: a function of time or of another variable.
struct FunctionCard {
  std::string name;
  std::vector<double> table;       ///< abscissa and ordinate in turn
  bool spline = false;             ///< join the table by a C² cubic spline instead of straight lines
  std::optional<double> period;    ///< the table or spline repeats with this period
  std::vector<double> sinus;       ///< amplitude, frequency [Hz], phase [degrees], mean
  std::vector<double> ramp;        ///< t0 y0 t1 y1: constant, straight line, constant
  std::vector<double> step;        ///< t0 y0 t1 y1: constant, C² polynomial, constant
  std::string expression;          ///< of T (and PI)
  std::vector<std::string> user;   ///< library and routine of the user's
  std::vector<double> parameters;  ///< of that routine
  std::vector<double> scale;       ///< of that routine's arguments; 0 or missing: chosen by who uses it
};

/// `.INI DEP|VIT NOEUD n C c V value`: initial displacements and velocities, a wish unless IMPOSED.
struct InitialCard : NodeTarget {
  Tagged kind;  ///< DISPLACEMENT, VELOCITY: from the record key
  std::vector<int> components;
  std::vector<double> values;
  bool imposed = false;  ///< must hold exactly: an error when the joints do not allow it
};

/// `.SAM TYPE STATIC|KINEMATIC|DYNAMIC …`: analysis, scheme and solver.
struct AnalysisCard {
  Tagged type{"STATIC", {}};
  Tagged scheme{"CHUNG", {}};   ///< CHUNG (generalised-alpha), NEWMARK, HHT, BOSSAK, RADAU
  std::optional<double> rho;    ///< spectral radius at infinity, CHUNG
  std::optional<double> alpha;  ///< HHT, BOSSAK
  Tagged solver{"MUMPS", {}};
  Tagged accuracy{"", {}};          ///< ACCURACY FAST, NORMAL, FINE, REFERENCE: chooses what the deck does not say
  Tagged start{"AS_GIVEN", {}};     ///< AS_GIVEN: assemble from the given positions; STATIC: from static equilibrium at the start
  bool scheme_is_free = false;      ///< ACCURACY has chosen the scheme
  std::optional<double> precision;  ///< of Newton, relative to the largest force in the model
  Tagged tangent{"FULL", {}};       ///< FULL, KEPT: whether tangents of a DYNAMIC analysis serve several iterations and steps
  int iterations = 20;              ///< most Newton iterations before the step is cut
  int cuts = 10;                    ///< most halvings of one step
  Tagged displacements{"", {}};     ///< DISPLACEMENTS SMALL, LARGE: of cells; by itself SMALL unless the deck has TYPE or .SUB
  Tagged mass{"CONSISTENT", {}};    ///< MASS CONSISTENT, LUMPED: of cells
  Tagged plane{"NO", {}};           ///< PLANE NO, AUTO, XY, YZ, ZX: three unknowns a node where all motion stays in a plane
  Tagged events{"YES", {}};         ///< EVENTS YES [tolerance] or NO: steps end where contact begins and ends
  double energy = 1;                ///< ENERGY: largest error of the energy balance, over the energy there was; 0: any
  std::optional<double> scale;      ///< k of the augmented Lagrangian; automatic when not given
  std::optional<double> penalty;    ///< p; automatic when not given
  std::string restart;              ///< RESTART: prefix of the results to restart from; empty: a new run
  std::optional<double> restart_time;  ///< T: of the restart point; the last when not given
};

/// `.SUB TF tf H h [TI ti]`: from, to, step.
struct SteppingCard {
  double start = 0;
  double end = 1;
  double step = 0.1;
  std::optional<double> tolerance;  ///< TOL: most local error of a step; not given: all steps are of H
  std::optional<double> longest;    ///< HMAX: longest step with TOL
};

/// `.PATH`: equilibria by the length of their path.
struct PathCard {
  std::optional<int> steps;
  std::optional<int> node, component;  ///< ends where this displacement is:
  std::optional<double> displacement;
  std::optional<int> branch;        ///< the bifurcation point, from 1, where another path is taken
  std::optional<double> amplitude;  ///< of the step to it
};

/// `.BUCKLING`: linearised buckling loads.
struct BucklingCard {
  int modes = 3;
  Tagged base{"START", {}};  ///< START, END: the equilibrium it is linearised at
};

/// `.SAI` what is archived: rate of the fields, rate of the histories, whose histories and which, and restart points.
struct ArchiveCard : NodeTarget {
  std::optional<double> field_step;             ///< CHAMPS/FIELDS DT: time between archived fields
  std::optional<double> history_step;           ///< HISTORY DT: time between history samples; 0 or missing: every step
  std::vector<int> codes;                       ///< STYP codes
  bool archives = false, of_structure = false;  ///< ARCHIVE STRUCTURE: words without effect
  bool newton = false;                          ///< NEWTON: the listing shows every iteration
  std::vector<int> elements;                    ///< ELEMENT ids and ranges whose histories are kept
  std::vector<std::string> kinds;               ///< TYPE names of cards whose elements' histories are kept
  std::vector<std::string> channels;            ///< CHANNEL: of those, only these
  Tagged keep;                                  ///< KEEP ALL, NONE: histories of all elements and nodes, or of none
  std::optional<double> restart_step;           ///< RESTART DT: time between restart points that stay in the file
};

/// `.CHK`: what the run must give.
struct CheckCard {
  std::optional<int> element;      ///< ELEMENT id
  std::optional<int> node;         ///< NODE id
  bool run = false;                ///< RUN: a quantity of the whole model (energies, steps, Newton order)
  std::string quantity;            ///< the channel: NORMAL_FORCE, UX, …; positional behind the id
  std::optional<double> time;      ///< T t: the value at that time; default: at the end
  std::vector<double> window;      ///< WINDOW t0 t1, for MIN MAX MEAN RMS AMPLITUDE
  Tagged measure{"VALUE", {}};     ///< VALUE MIN MAX MEAN RMS AMPLITUDE (half of max - min)
  double value = 0;                ///< V
  std::optional<double> relative;  ///< RTOL
  std::optional<double> absolute;  ///< ATOL
  std::string reference;           ///< REF "where the number comes from"
};

/// The schemas of all general commands, in the order of the manual.
const std::vector<Schema>& general_commands();

/// The `.SAM` that counts; nullptr without one.
const AnalysisCard* last_analysis(const std::vector<Record>& records);
/// Whether a deck says what is analysed, by `.SUB` or TYPE of `.SAM`; a mesh without is one of linear statics.
bool says_analysis(const std::vector<Record>& records);
/// Whether the displacements of a deck with a mesh count as small: DISPLACEMENTS of the last `.SAM`, or what says_analysis()
/// tells.
bool has_small_displacements(const std::vector<Record>& records);
/// Whether the last `.SAM` puts the masses of cells at their nodes.
bool has_lumped_masses(const std::vector<Record>& records);

}  // namespace engrane::deck
