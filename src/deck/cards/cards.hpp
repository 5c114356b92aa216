// SPDX-License-Identifier: BSD-3-Clause
// Structs of the general commands of a deck (`.NOE`, `.CLM`, `.SAM`, …). Elements declare theirs next to their physics.
#pragma once

#include <algorithm>
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

/// `.NOE`: `I 12 X 0 0 5` or the row `12 0. 0. 5.`, in the global frame or the `.FRAME` given by FRAME.
struct NodeCard {
  std::array<double, 3> x{0, 0, 0};
  int frame = 0;  ///< 0: the global frame
};

/// `.FRAME I 3 ORIGIN x y z V1 x y z V2 x y z [CYL|SPH]`: origin, first axis, a vector in the half plane of the second axis.
struct FrameCard {
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> first{1, 0, 0};
  std::array<double, 3> second{0, 1, 0};
  Tagged kind{"CARTESIAN", {}};
};

/// `.SEL GROUP n NOM "x" NOEUDS …`: a named set of nodes, elements or faces.
struct GroupCard {
  int number = 0;
  std::string name;
  Tagged kind{"NODES", {}};         ///< NODES, ELEMENTS, FACES
  bool all = false;                 ///< TOUT
  std::vector<int> ids;             ///< ids and ranges `1 A 20`, expanded by the reader; for FACES, pairs of a cell and a face
  std::vector<std::string> united;  ///< UNION: names or numbers of groups
  std::vector<double> box;          ///< BOITE xmin xmax ymin ymax zmin zmax
  std::optional<int> attribute;     ///< MAILLE AT n
  bool of_file = false;             ///< of a mesh file: nobody chose its number

  // Several records may give one group. Set when the deck has been read, the same for all of them.
  int group = 0;                   ///< number of the first of the records
  std::vector<std::string> names;  ///< name and numbers of the group, by which others refer to it

  bool is_called(const std::string& wanted) const { return std::find(names.begin(), names.end(), wanted) != names.end(); }
};

/// `.MAT I id NOM "steel" BEHA "ELASTIC" YT … NT … M …`; orthotropic with `YT e1 e2 e3 NT n12 n23 n13 G g12 g23 g13`.
struct MaterialCard {
  std::string name;
  std::string behaviour = "ELASTIC";
  std::vector<double> young, poisson, shear, expansion;  ///< one value, or one for each of three axes; empty: not given
  std::optional<double> density;
  double damping = 0;  ///< Kelvin–Voigt time
};

/// The nodes a record of `.CLM` or `.INI` applies to.
struct NodeTarget {
  std::vector<int> nodes;           ///< NOEUD ids and ranges
  std::vector<std::string> groups;  ///< GROUP names or numbers
};

/// `.CLM FIX NOEUD n C 1 2 3`
struct FixCard : NodeTarget {
  std::vector<int> components;  ///< 1–3 translations, 4–6 rotations
};

/// `.CLM TEMP GROUP "rim" V 80. [NF f]`: temperature rise of nodes above the stress-free state.
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
  std::vector<double> table;       ///< abscissa and ordinate alternately
  bool spline = false;             ///< join the table by a C² cubic spline instead of straight lines
  std::optional<double> period;    ///< period of the table or spline
  std::vector<double> sinus;       ///< amplitude, frequency [Hz], phase [degrees], mean
  std::vector<double> ramp;        ///< t0 y0 t1 y1: constant, straight line, constant
  std::vector<double> step;        ///< t0 y0 t1 y1: constant, C² polynomial, constant
  std::string expression;          ///< of T or X, and PI; for a law, of D, V and T
  std::vector<std::string> user;   ///< library and routine name of a user routine
  std::vector<double> parameters;  ///< of that routine
  std::vector<double> scale;       ///< of that routine's arguments; 0 or missing: chosen where the function is used
};

/// `.INI DEP|VIT NOEUD n C c V value`: initial displacements and velocities; desired values unless IMPOSED.
struct InitialCard : NodeTarget {
  Tagged kind;  ///< DISPLACEMENT or VELOCITY, from the record key
  std::vector<int> components;
  std::vector<double> values;
  bool imposed = false;  ///< must hold exactly: an error if the joints do not allow it
};

/// `.SAM TYPE STATIC|KINEMATIC|DYNAMIC …`: analysis, scheme and solver.
struct AnalysisCard {
  Tagged type{"STATIC", {}};
  Tagged scheme{"CHUNG", {}};   ///< CHUNG (generalised-alpha), NEWMARK, HHT, BOSSAK, RADAU
  std::optional<double> rho;    ///< spectral radius at infinity, CHUNG
  std::optional<double> alpha;  ///< HHT, BOSSAK
  Tagged solver{"MUMPS", {}};
  Tagged accuracy{"", {}};          ///< ACCURACY FAST, NORMAL, FINE, REFERENCE: sets what the deck does not give
  Tagged start{"AS_GIVEN", {}};     ///< AS_GIVEN: assembled from the given positions; STATIC: starts from static equilibrium
  bool scheme_is_free = false;      ///< ACCURACY has chosen the scheme
  std::optional<double> precision;  ///< tolerance of Newton's iteration, relative to the largest force in the model
  Tagged tangent{"FULL", {}};       ///< FULL, KEPT: whether a DYNAMIC analysis reuses tangents for several iterations and steps
  int iterations = 20;              ///< maximum number of Newton iterations before the step is cut
  int cuts = 10;                    ///< maximum number of halvings of a step
  Tagged displacements{"", {}};     ///< DISPLACEMENTS SMALL, LARGE: of cells; default: has_small_displacements()
  Tagged mass{"CONSISTENT", {}};    ///< MASS CONSISTENT, LUMPED: of cells
  Tagged plane{"NO", {}};           ///< PLANE NO, AUTO, XY, YZ, ZX: three unknowns per node if all motion stays in a plane
  Tagged events{"YES", {}};         ///< EVENTS YES [tolerance] or NO: whether steps end where contact begins or ends
  double energy = 1;                ///< ENERGY: largest relative error of the energy balance; 0: no limit
  std::optional<double> scale;      ///< k of the augmented Lagrangian; automatic when not given
  std::optional<double> penalty;    ///< p of the augmented Lagrangian; 0 if not given
  std::string restart;              ///< RESTART: prefix of the results to restart from; empty: a new run
  std::optional<double> restart_time;  ///< T: time of the restart point; the last one if not given
};

/// `.SUB TF tf H h [TI ti]`: time span and time step.
struct SteppingCard {
  double start = 0;
  double end = 1;
  double step = 0.1;
  std::optional<double> tolerance;  ///< TOL: largest local error of a step; not given: all steps have length H
  std::optional<double> longest;    ///< HMAX: longest step, with TOL
};

/// `.PATH`: continuation of equilibria along their arc length.
struct PathCard {
  std::optional<int> steps;
  std::optional<int> node, component;  ///< with `displacement`: the path ends when this component of this node reaches it
  std::optional<double> displacement;
  std::optional<int> branch;        ///< number of the bifurcation point, from 1, at which the path branches
  std::optional<double> amplitude;  ///< of the branching step
};

/// `.BUCKLING`: linearised buckling loads.
struct BucklingCard {
  int modes = 3;
  Tagged base{"START", {}};  ///< START, END: the equilibrium about which buckling is linearised
};

/// `.SAI`: what is archived: intervals of fields and histories, selection of histories, and restart points.
struct ArchiveCard : NodeTarget {
  std::optional<double> field_step;             ///< CHAMPS/FIELDS DT: time between archived fields
  std::optional<double> history_step;           ///< HISTORY DT: time between history samples; 0 or missing: every step
  std::vector<int> codes;                       ///< STYP codes
  bool archives = false, of_structure = false;  ///< ARCHIVE STRUCTURE: accepted without effect
  bool newton = false;                          ///< NEWTON: list every Newton iteration
  std::vector<int> elements;                    ///< ELEMENT ids and ranges whose histories are kept
  std::vector<std::string> kinds;               ///< TYPE names of cards; histories of their elements are kept
  std::vector<std::string> channels;            ///< CHANNEL: restricts the selected histories to these
  Tagged keep;                                  ///< KEEP ALL, NONE: histories of all elements and nodes, or of none
  std::optional<double> restart_step;           ///< RESTART DT: time between restart points that stay in the file
};

/// `.CHK`: an expected result of the run.
struct CheckCard {
  std::optional<int> element;      ///< ELEMENT id
  std::optional<int> node;         ///< NODE id
  bool run = false;                ///< RUN: a quantity of the whole model (energies, steps, Newton order)
  std::string quantity;            ///< channel: NORMAL_FORCE, UX, …; positional, after the id
  std::optional<double> time;      ///< T t: the value at that time; default: at the end
  std::vector<double> window;      ///< WINDOW t0 t1, for MIN MAX MEAN RMS AMPLITUDE
  Tagged measure{"VALUE", {}};     ///< VALUE MIN MAX MEAN RMS AMPLITUDE (half of max - min)
  double value = 0;                ///< V
  std::optional<double> relative;  ///< RTOL
  std::optional<double> absolute;  ///< ATOL
  std::string reference;           ///< REF "source of the reference value"
};

/// The schemas of all general commands, in the order of the manual.
const std::vector<Schema>& general_commands();

/// The last `.SAM`, which is the one in effect; nullptr without one.
const AnalysisCard* last_analysis(const std::vector<Record>& records);
/// Whether a deck specifies an analysis, by `.SUB`, `.PATH`, `.BUCKLING` or TYPE of `.SAM`. Otherwise a mesh is solved in
/// linear statics.
bool says_analysis(const std::vector<Record>& records);
/// Whether the displacements of a deck with a mesh are treated as small: by DISPLACEMENTS of the last `.SAM`, otherwise if
/// says_analysis() is false.
bool has_small_displacements(const std::vector<Record>& records);
/// Whether the last `.SAM` specifies lumped masses for cells.
bool has_lumped_masses(const std::vector<Record>& records);

}  // namespace engrane::deck
