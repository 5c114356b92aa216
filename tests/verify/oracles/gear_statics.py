# SPDX-License-Identifier: BSD-3-Clause
"""Closed-form forces between a pair of gears in equilibrium, without friction unless stated.

Forces act on the member named; tangential W_t > 0 in the sense that gives the torque, radial W_r > 0 towards
that member's axle for external gears (the pair is pushed apart), axial W_a as stated. Angles in radians, any
consistent units.
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Components(NamedTuple):
    """Force components in shaft terms and the normal force on the tooth."""

    tangential: float
    radial: float
    axial: float
    normal: float


def helical(torque: float, radius: float, alpha_n: float, helix: float = 0.0) -> Components:
    """Parallel axles. `helix` > 0: right hand. W_r = W_t tan(alpha_n)/cos(helix), W_a = W_t tan(helix).

    The axial component is given positive; on the driving member it points along axle x W_t sense reversed by
    the hand: a right-hand driver that turns as a right-hand screw is pushed back along its own advance."""
    w = torque / radius
    return Components(
        w,
        w * math.tan(alpha_n) / math.cos(helix),
        w * math.tan(helix),
        w / (math.cos(helix) * math.cos(alpha_n)),
    )


def spur(torque: float, radius: float, alpha_n: float) -> Components:
    """Helical without the helix: W_r = W_t tan(alpha), W_a = 0."""
    return helical(torque, radius, alpha_n)


def internal(
    torque: float, radius: float, alpha_n: float, helix: float = 0.0
) -> tuple[Components, Components]:
    """Pinion of `radius` inside a ring gear: components on the pinion (radial towards its axle) and on the
    ring (equal and opposite force; towards the ring's axle it counts negative: the ring is pushed
    outwards)."""
    pinion = helical(torque, radius, alpha_n, helix)
    ring = Components(pinion.tangential, -pinion.radial, -pinion.axial, pinion.normal)
    return pinion, ring


def bevel(
    torque: float, radius: float, alpha_n: float, cone: float, spiral: float = 0.0, sense: int = 1
) -> Components:
    """One member of a bevel or hypoid pair with its own pitch angle and spiral at the mean radius `radius`.

    Axial is away from the apex, radial towards the axle: W_t/cos(psi) (tan(phi_n) sin(gamma) + s sin(psi)
    cos(gamma)) and W_t/cos(psi) (tan(phi_n) cos(gamma) - s sin(psi) sin(gamma)); `sense` s = +1 or -1 by hand
    and sense of turning."""
    w = torque / radius
    k = w / math.cos(spiral)
    t, sg, cg = math.tan(alpha_n), math.sin(cone), math.cos(cone)
    s = sense * math.sin(spiral)
    return Components(w, k * (t * cg - s * sg), k * (t * sg + s * cg), k / math.cos(alpha_n))


def bevel_pitch_angles(z_a: int, z_b: int, shaft_angle: float = math.pi / 2) -> tuple[float, float]:
    """Pitch cone angles of two bevel gears whose axles cross at `shaft_angle`."""
    a = math.atan2(math.sin(shaft_angle), z_b / z_a + math.cos(shaft_angle))
    return a, shaft_angle - a


def hypoid(z_p: int, z_g: int, psi_p: float, psi_g: float, r_g: float) -> dict[str, float]:
    """Pinion radius, ratio of tangential forces W_tP/W_tG, ratio of torques T_G/T_P of a hypoid pair: the
    normal pitch and the normal force are common, so r = z p_n/(2 pi cos(psi)) and W_t = W cos(alpha_n)
    cos(psi)."""
    return {
        "pinion_radius": r_g * z_p / z_g * math.cos(psi_g) / math.cos(psi_p),
        "force_ratio": math.cos(psi_p) / math.cos(psi_g),
        "torque_ratio": z_g / z_p,
        "speed_ratio": z_g / z_p,
    }


def crossed_helical(
    torque_a: float, z_a: int, z_b: int, module: float, helix_a: float, helix_b: float, alpha_n: float
) -> tuple[Components, Components]:
    """Crossed axles (shaft angle helix_a + helix_b, both counted right hand): components on A and on B. The
    normal force is common; every member's torque is W cos(alpha_n) cos(helix) r with 2 r cos(helix) = z
    m_n."""
    r_a = z_a * module / (2 * math.cos(helix_a))
    normal = torque_a / (r_a * math.cos(helix_a) * math.cos(alpha_n))

    def member(helix: float) -> Components:
        c = normal * math.cos(alpha_n)
        return Components(c * math.cos(helix), normal * math.sin(alpha_n), c * math.sin(helix), normal)

    if z_b <= 0:
        raise ValueError("z_b must be positive")
    return member(helix_a), member(helix_b)


def worm(tangential: float, lead: float, alpha_n: float, friction: float = 0.0) -> dict[str, float]:
    """Worm that drives with the tangential force W_x = `tangential` (lead angle `lead`): normal force W, W_y
    separating, W_z along the worm's axle (tangential on the wheel), efficiency, and the friction above which
    the wheel cannot drive."""
    cn, sl, cl = math.cos(alpha_n), math.sin(lead), math.cos(lead)
    w = tangential / (cn * sl + friction * cl)
    return {
        "W": w,
        "W_x": tangential,
        "W_y": w * math.sin(alpha_n),
        "W_z": w * (cn * cl - friction * sl),
        "efficiency": (cn - friction * math.tan(lead)) / (cn + friction / math.tan(lead)),
        "self_locking_friction": cn * math.tan(lead),
    }


def wheel_drives_worm(lead: float, alpha_n: float, friction: float) -> float:
    """Efficiency when the wheel drives; nothing comes out of a worm that locks itself, friction >=
    cos(alpha_n) tan(lead)."""
    cn = math.cos(alpha_n)
    return max(0.0, (cn - friction / math.tan(lead)) / (cn + friction * math.tan(lead)))


def worm_of_shigley() -> dict[str, float]:
    """Two threads, 30 teeth, transverse pitch 6 per inch, worm pitch diameter 2 in, 1 hp at 1200 rpm, 14.5
    degrees, f = 0.03."""
    axial_pitch = math.pi / 6
    lead = math.atan(2 * axial_pitch / (math.pi * 2.0))
    speed = math.pi * 2.0 * 1200 / 12  # ft/min
    return worm(33000.0 / speed, lead, math.radians(14.5), 0.03) | {"lead_degrees": math.degrees(lead)}


def willis(z_s: int, z_r: int) -> dict[str, float]:
    """Planetary set with the ring held: carrier over sun speed, planet over sun speed (absolute), torque
    shares T_s:T_r:T_c."""
    z_p = (z_r - z_s) / 2
    carrier = z_s / (z_s + z_r)
    return {
        "carrier": carrier,
        "planet": carrier - (1 - carrier) * z_s / z_p,
        "torque_ring": z_r / z_s,
        "torque_carrier": -(z_s + z_r) / z_s,
    }


def paper_bevel(turn: float, moment: float = 1000.0) -> dict[str, float | tuple[float, float, float]]:
    """Cardona (1995), first example: wheel A fixed at the origin, wheel B carried round it by `turn` radians.

    Normal force M/(r_B cos 20 deg), turn of B in the bar, contact point, force and moment about the origin on
    A's foundation (for the sense of the torque that pushes A along +tangent)."""
    alpha, cone_b = math.radians(20), math.atan(0.2)
    s, c = math.sin(turn), math.cos(turn)
    contact = (5 * s, 0.0, 5 * c)
    radial = moment * math.tan(alpha)
    # Towards B's apex side: the common normal of the pitch cones, (sin g_B, cos g_B) in the (radial, y)
    # plane.
    sg, cg = math.sin(cone_b), math.cos(cone_b)
    force = (moment * c - radial * sg * s, -radial * cg, -moment * s - radial * sg * c)
    torque = (
        contact[1] * force[2] - contact[2] * force[1],
        contact[2] * force[0] - contact[0] * force[2],
        contact[0] * force[1] - contact[1] * force[0],
    )
    return {
        "normal": moment / math.cos(alpha),
        "turn_of_b": 5 * turn,
        "contact": contact,
        "force": force,
        "moment": torque,
    }
