// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "assembly/assembler.hpp"
#include "solve/algebra/newton.hpp"

namespace engrane::solve {

struct Mobility;

/// Resistance to a motion: only of forces that depend on the position (statics, or the static start of dynamics), or of inertia
/// too.
enum class Resistance { at_rest, at_start, in_motion };

/// Names the motion or the reactions that make the matrix of `assembler` singular: returns `what`, followed by the unknowns of
/// the nearest null vector. Collective.
std::string explain_singular(Assembler& assembler, const std::string& what, Resistance resistance = Resistance::in_motion);

/// Text like that of explain_singular() for a null vector that is known, by equation; on every rank.
std::string explain_null_vector(const Assembler& assembler, const std::string& what, std::span<const double> null,
                                Resistance resistance);

/// Names the motion that nothing resists in an equilibrium whose tangent is singular up to rounding: returns `what`, followed by
/// the motion and advice; empty if the tangent is regular, and for more than 100 000 equations. Overwrites the matrix of
/// `assembler`. Collective.
std::string explain_unresisted(Assembler& assembler, const Configuration& equilibrium, const std::string& what,
                               Resistance resistance = Resistance::at_rest);

/// "; if all motion is in the plane of the cells, .SAM PLANE XY solves it there"; empty without plane cells in a model of space.
std::string plane_advice(const Model& model);

/// Names a motion that no drive determines, of a mechanism with this mobility; empty if there is none.
std::string explain_free_motion(Assembler& assembler, const Configuration& configuration, const Mobility& mobility);

/// Advice where nodes of small displacements turn far in a model that is not linear, as to follow explain_residual(); else empty.
std::string explain_small_turns(const Model& model, const Configuration& tried);

/// Says where a Newton iteration got stuck: "largest residual at node 57 (rz) from HINGE 3".
std::string explain_residual(Assembler& assembler, const Configuration& configuration, const NewtonReport& report);

/// Names the element whose stiffness makes the rounding of positions a visible part of the loads; empty if there is none.
/// `one_tangent`: the assembler's matrix holds the one tangent of a linear model. `energy`: what was in the machine or passed
/// through it. Collective.
std::string explain_unresolved(const Assembler& assembler, const References& references, bool one_tangent,
                               const Configuration& configuration, double energy);

/// Words after the name of an element whose forces are not finite, if the element knows no reason.
inline constexpr const char* gives_not_finite = "gives a force or a slope of it that is not a finite number";

/// Names the first element whose forces or tangent are not finite numbers; empty when all are.
std::string explain_not_finite(Assembler& assembler, const Configuration& configuration);

}  // namespace engrane::solve
