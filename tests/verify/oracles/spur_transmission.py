# SPDX-License-Identifier: BSD-3-Clause
"""The spur gear transmission of Cardona (1995), second example, as an ordinary differential equation.

Units: inch, pound-force, second (masses in lbf s^2/in). Angles in radians.

Model. Disc 1 turns at OMEGA about +z by force; shaft 1, wheel A (at the origin), wheel B (at (2r, 0)), shaft
2, disc 2. Angles about +z: theta_A; theta_B and theta_2 count about -z, so that all three grow with OMEGA.
The pair's frame follows the line of centres, which stands at the angle f from x (f = 0 when the supports are
rigid), so with the paper's (16), (21), (22)

    psi_A = theta_A - f,   u = r (psi_A + psi_B) = r (theta_A - theta_B - 2 f),   x = u + x_err(psi_A)

The tooth has the potential k_m [[x]]^2 / 2 (28) and the damper c_m du/dt (32). Lagrange's equations give,
with S = k_m [[x]], F = S + c_m du/dt, P = S x_err'(psi_A), L the distance of the centres and n the normal of
their line,

    I_A theta_A'' = -k_t1 (theta_A - OMEGA t) - c_t1 (theta_A' - OMEGA) - r F - P
    I_B theta_B'' =  r F - k_t2 (theta_B - theta_2) - c_t2 (theta_B' - theta_2')
    I_2 theta_2'' =  k_t2 (theta_B - theta_2) + c_t2 (theta_B' - theta_2') - T
    m x_A'' = -n (2 r F + P)/L - e |F| tan(alpha) - k x_A - c x_A',    m x_B'' = the same with both mesh terms
    reversed

The term P/L is the reaction of the pair's frame to the torque P: without it the pair would lean on the
ground. `frame=False` gives the equations with psi_A = theta_A, small displacements and no P/L (the form
usually printed). The multiplier of the paper's constraint (21) is the normal force F/cos(alpha): that is the
reported number.

Which flank. F > 0 presses A's leading flank: A drives B. That needs T > 0, a moment about **+z** on disc 2,
which turns about -z. The card `CHA NOEUD 4 C 6 V -945.8` with disc 1 turning about +z is T = -945.8: the
torque then helps disc 2 along, B pushes A, F < 0 and the loaded flank is the other one, x <= -b. Reversing T
nearly mirrors the force (x_err reversed is x_err half a tooth later but for a constant), not exactly: P and
the wind-up inside x_err keep their sign (amplitude in case A: 5996.0 against 5997.2 lbf).

Contact. Each corner of [[.]] is exact, or rounded over the width `smooth` (engrane's SMOOTH) by a ramp whose
slope is 3 t^2 - 2 t^3. Damping ALWAYS is the paper's. CONTACT damps the approach of the flanks, c_m dx/dt,
only while a flank touches (times the ramp's slope), and never makes it pull: where it would exceed the
elastic force it takes that away and no more, rounded between 90 and 110 %. P then includes the damper's
force.

Start: static equilibrium under T with disc 1 held at angle 0 (x_err taken at the static psi_A, zero in the
unloaded reference), and all wheels turning at OMEGA.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import root

OMEGA = 12000 * 2 * math.pi / 60


def ramp(x: float, width: float) -> tuple[float, float]:
    """max(x, 0) with a rounded corner, and its slope."""
    if x >= width / 2:
        return x, 1.0
    if x <= -width / 2:
        return 0.0, 0.0
    t = x / width + 0.5
    return width * (t**3 - t**4 / 2), 3 * t**2 - 2 * t**3


@dataclass(frozen=True)
class Transmission:
    """Data of the transmission as printed; `flexible` supports are the cases B and D, `b` > 0 the cases C and
    D."""

    flexible: bool = False
    b: float = 0.0
    X: float = 0.003937
    damping: str = "ALWAYS"  # ALWAYS: c_m u' at all times; CONTACT: c_m x' on a flank, which never pulls
    smooth: float = 0.0  # width of the rounded corners, as a fraction of b
    torque: float = 945.8  # T, moment about +z on disc 2; positive: A drives B
    frame: bool = True
    z: int = 25
    r: float = 3.937 / 2
    alpha: float = math.radians(20)
    km: float = 1.477e7
    xi: float = 0.1
    ia: float = 0.0102
    ib: float = 0.0102
    i2: float = 0.0102
    m: float = 5.36e-3
    kt1: float = 1.7e4
    ct1: float = 0.076026
    kt2: float = 3.0e4
    ct2: float = 0.12369
    ks: float = 1.477e7
    cs: float = 50.0

    @property
    def cm(self) -> float:
        """Tooth damper (32) with the equivalent mass (33); lbf s/in."""
        me = self.ia * self.ib / (self.ia * self.r**2 + self.ib * self.r**2)
        return 2 * self.xi * math.sqrt(self.km * me)

    @property
    def period(self) -> float:
        """Tooth period, s."""
        return 2 * math.pi / (self.z * OMEGA)

    @property
    def size(self) -> int:
        return 14 if self.flexible else 6

    def tooth(self, x: float, udot: float, xdot: float) -> tuple[float, float]:
        """Elastic force k_m [[x]] and what the damper adds to it."""
        if self.b == 0:
            return self.km * x, self.cm * udot
        w = self.smooth * self.b
        front, back = ramp(x, w), ramp(-self.b - x, w)
        elastic = self.km * (front[0] - back[0])
        if self.damping == "ALWAYS":
            return elastic, self.cm * udot
        return elastic, self._flank(front, xdot) - self._flank(back, -xdot)

    def _flank(self, touch: tuple[float, float], rate: float) -> float:
        """Damping on one flank; touch: ramp and its slope."""
        free, elastic = self.cm * touch[1] * rate, self.km * touch[0]
        if free >= 0 or touch[1] == 0:
            return free
        if free <= -1.1 * elastic:
            return -elastic
        return elastic * (ramp(1 + free / elastic, 0.2)[0] - 1)

    def mesh(self, t: float, y: np.ndarray) -> dict[str, float]:
        """Everything about the tooth at one instant. y = (positions, velocities), positions theta_A - OMEGA
        t, theta_B - OMEGA t, theta_2 - OMEGA t and, when flexible, (x_A, y_A, x_B, y_B)."""
        h = self.size // 2
        f = fdot = 0.0
        length, e = 2 * self.r, (1.0, 0.0)
        if self.flexible:
            dx, dy = y[5] - y[3], y[6] - y[4]
            vx, vy = y[h + 5] - y[h + 3], y[h + 6] - y[h + 4]
            if self.frame:
                lx = 2 * self.r + dx
                length = math.hypot(lx, dy)
                e = (lx / length, dy / length)
                f, fdot = math.atan2(dy, lx), (-e[1] * vx + e[0] * vy) / length
            else:
                f, fdot = dy / length, vy / length
        psi = OMEGA * t + y[0] - (f if self.frame else 0.0)
        u = self.r * (y[0] - y[1] - 2 * f)
        udot = self.r * (y[h] - y[h + 1] - 2 * fdot)
        a = self.z * psi
        x = u + self.X * (1 - math.cos(a))
        slope = self.X * self.z * math.sin(a)
        s, d = self.tooth(x, udot, udot + slope * (OMEGA + y[h] - (fdot if self.frame else 0.0)))
        along = s if self.damping == "ALWAYS" or self.b == 0 else s + d
        flank = 1 if x >= 0 else (-1 if x <= -self.b else 0)
        return dict(
            u=u, udot=udot, x=x, psi=psi, F=s + d, P=along * slope, L=length, ex=e[0], ey=e[1], flank=flank
        )

    def forces(self, t: float, y: np.ndarray) -> list[float]:
        """Generalised forces on the positions (static part and dampers)."""
        q = self.mesh(t, y)
        h = self.size // 2
        shaft2 = self.kt2 * (y[1] - y[2]) + self.ct2 * (y[h + 1] - y[h + 2])
        out = [
            -self.kt1 * y[0] - self.ct1 * y[h] - self.r * q["F"] - q["P"],
            self.r * q["F"] - shaft2,
            shaft2 - self.torque,
        ]
        if self.flexible:
            tangential = (2 * self.r * q["F"] + (q["P"] if self.frame else 0.0)) / q["L"]
            radial = abs(q["F"]) * math.tan(self.alpha)
            fx = q["ey"] * tangential - q["ex"] * radial
            fy = -q["ex"] * tangential - q["ey"] * radial
            for i, (load, sign) in enumerate(((fx, 1), (fy, 1), (fx, -1), (fy, -1))):
                out.append(sign * load - self.ks * y[3 + i] - self.cs * y[h + 3 + i])
        return out

    def rhs(self, t: float, y: np.ndarray) -> np.ndarray:
        y = y.tolist()
        f = self.forces(t, y)
        inertia = (self.ia, self.ib, self.i2, self.m, self.m, self.m, self.m)
        return np.array(y[self.size // 2 :] + [fi / m for fi, m in zip(f, inertia, strict=False)])

    def start(self) -> np.ndarray:
        """Static equilibrium on the flank that T loads, velocities relative to OMEGA zero."""
        side = 1 if self.torque > 0 else -1
        h = self.size // 2
        a0 = -self.torque / self.kt1
        x0 = self.X * (1 - math.cos(self.z * a0))
        b0 = a0 - (self.torque / self.r / self.km - (self.b if side < 0 else 0.0) - x0) / self.r
        guess = np.zeros(h)
        guess[:3] = a0, b0, b0 - self.torque / self.kt2
        scale = np.array([self.torque] * 3 + [self.torque / self.r] * (h - 3))
        zero = np.zeros(h)
        still = replace(self, xi=0.0)  # nothing turns yet, whose teeth would be damped
        sol = root(lambda q: np.array(still.forces(0.0, np.concatenate([q, zero]))) / scale, guess, tol=1e-14)
        if np.abs(sol.fun).max() > 1e-9:
            raise RuntimeError(f"no static equilibrium: residual {np.abs(sol.fun).max():.1e}")
        return np.concatenate([sol.x, zero])


CASES = {
    "A": Transmission(),
    "B": Transmission(flexible=True),
    "C": Transmission(b=0.001968),
    "D": Transmission(flexible=True, b=0.001968),
}


def build(case: str, damping: str = "ALWAYS", **changes: float | None) -> Transmission:
    """One of the paper's four cases with a damping law (ALWAYS or CONTACT) and changed data."""
    if damping not in ("ALWAYS", "CONTACT"):
        raise ValueError(f"unknown damping law {damping}")
    return replace(
        CASES[case.upper()], damping=damping, **{k: v for k, v in changes.items() if v is not None}
    )


def integrate(
    model: Transmission, t0: float, y0: np.ndarray, t1: float, rtol: float, samples: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Dormand-Prince 8(5,3) from t0 to t1; returns the states at `samples` (n x size) and the final state.
    The error control finds the corners by itself, and the step never exceeds 1/40 tooth period."""
    out = np.empty((len(samples), model.size))
    done = 0
    # Positions are of order 1e-5 (tooth deflection) to 1e-1 (wind-up): one absolute tolerance far below both.
    atol = np.r_[np.full(model.size // 2, rtol * 1e-5), np.full(model.size // 2, rtol)]
    solver = DOP853(model.rhs, t0, np.array(y0, float), t1, rtol=rtol, atol=atol, max_step=model.period / 40)
    while done < len(samples) and samples[done] <= t0:
        out[done] = y0
        done += 1
    while solver.status == "running":
        message = solver.step()
        if solver.status == "failed":
            raise RuntimeError(f"integration failed at t = {solver.t}: {message}")
        passed = int(np.searchsorted(samples, solver.t, "right"))
        if done < passed:
            out[done:passed] = solver.dense_output()(samples[done:passed]).T
            done = passed
    out[done:] = solver.y
    return out, solver.y.copy()


def record(model: Transmission, t: np.ndarray, states: np.ndarray) -> dict[str, np.ndarray]:
    """Named channels of sampled states: t, F (tooth force), normal (F/cos alpha), u, x, flank, psi, state."""
    rows = [model.mesh(ti, yi) for ti, yi in zip(t, states, strict=True)]
    out = {k: np.array([row[k] for row in rows]) for k in ("F", "u", "udot", "x", "psi", "flank")}
    return {"t": np.asarray(t), "normal": out["F"] / math.cos(model.alpha), "state": states, **out}


def simulate(
    case: str,
    damping: str = "ALWAYS",
    t_end: float = 0.03,
    rtol: float = 1e-10,
    X: float | None = None,
    b: float | None = None,
    torque: float | None = None,
    times: np.ndarray | None = None,
    frame: bool = True,
) -> dict[str, np.ndarray]:
    """Integrates from the start state to t_end; samples at `times`, or 64 per tooth period. See `record` for
    the channels."""
    model = build(case, damping, X=X, b=b, torque=torque, frame=frame)
    if times is None:
        times = np.linspace(0, t_end, round(t_end / model.period * 64) + 1)
    states, _ = integrate(model, 0.0, model.start(), t_end, rtol, np.asarray(times))
    return record(model, np.asarray(times), states)


def statistics(t: np.ndarray, f: np.ndarray, flank: np.ndarray | None = None, count: int = 5) -> dict:
    """mean, amplitude (half of maximum minus minimum), rms about the mean, minimum, maximum, the strongest
    frequencies (Hz, amplitude) of a uniformly sampled force and the shares of time on each flank."""
    f = np.asarray(f)
    n = len(f) - 1  # the last sample repeats the first of a whole number of periods
    window = np.hanning(n + 1)[:n]
    spectrum = np.abs(np.fft.rfft((f[:n] - f[:n].mean()) * window)) * 2 / window.sum()
    hz = np.fft.rfftfreq(n, t[1] - t[0])
    peaks = [
        i for i in range(1, len(hz) - 1) if spectrum[i] > spectrum[i - 1] and spectrum[i] >= spectrum[i + 1]
    ]
    peaks.sort(key=lambda i: -spectrum[i])
    out = dict(mean=f[:n].mean(), amplitude=np.ptp(f) / 2, rms=f[:n].std(), minimum=f.min(), maximum=f.max())
    out["peaks"] = [(float(hz[i]), float(spectrum[i])) for i in peaks[:count]]
    if flank is not None:
        out["share"] = {k: float(np.mean(flank[:n] == k)) for k in (1, 0, -1)}
    return out


def settle(model: Transmission, periods: int, rtol: float = 1e-8, factor: float = 130.0) -> np.ndarray:
    """State after `periods` tooth periods with stiffer shaft dampers: the shafts' own modes (0.2 % damped)
    would ring for seconds otherwise. A steady state must then be continued with the true dampers."""
    soft = replace(model, ct1=model.ct1 * factor, ct2=model.ct2 * factor)
    return integrate(soft, 0.0, model.start(), periods * model.period, rtol, np.empty(0))[1]


def periodic(
    model: Transmission, y0: np.ndarray, every: int = 1, rtol: float = 1e-11
) -> tuple[np.ndarray, float]:
    """Newton's method on the map over `every` tooth periods. Returns the state on the orbit and the largest
    modulus of the map's multipliers (below 1: the orbit attracts). Without backlash the map is nearly linear
    and the orbit unique."""
    span, n = every * model.period, model.size
    empty = np.empty(0)
    scale = np.r_[np.full(n // 2, 1e-6), np.full(n // 2, 1e-2)]
    y = np.array(y0, float)
    best = math.inf
    for _ in range(12):
        image = integrate(model, 0.0, y, span, rtol, empty)[1]
        jac = np.empty((n, n))
        for j in range(n):
            step = np.zeros(n)
            step[j] = scale[j]
            jac[:, j] = (integrate(model, 0.0, y + step, span, rtol, empty)[1] - image) / scale[j]
        change = np.linalg.solve(np.eye(n) - jac, image - y)
        y = y + change
        best = float(np.abs(change / scale).max())
        if best < 1e-4:
            return y, float(np.abs(np.linalg.eigvals(jac)).max())
    raise RuntimeError(f"no periodic orbit of {every} tooth periods near here (last change {best:.1e})")


def steady(
    case: str,
    damping: str = "ALWAYS",
    periods: int = 100,
    settling: int = 400,
    rtol: float = 1e-9,
    **changes: float | None,
) -> dict:
    """Statistics of the normal force in the steady state over whole tooth periods.

    Settles with stiff shaft dampers, then looks for an orbit nearby that repeats after 1, 2 or 4 tooth
    periods (`tooth_periods`); `multiplier` is the largest modulus of its map's multipliers. A and B always
    have one. Where C or D have none that attracts, the true dampers run for `periods` tooth periods and the
    next `periods` are measured; both keys are then missing."""
    model = build(case, damping, **changes)
    y = settle(model, settling)
    found: dict = {}
    for every in (1,) if model.b == 0 else (1, 2, 4):
        try:
            orbit, multiplier = periodic(model, y, every)
        except (RuntimeError, np.linalg.LinAlgError):
            continue
        if multiplier < 1:
            y, found = orbit, {"multiplier": multiplier, "tooth_periods": every}
            break
    every, fine = 4, 1024
    if not found:
        every, fine = periods, 256
        y = integrate(model, 0.0, y, periods * model.period, rtol, np.empty(0))[1]
    t = np.linspace(0, every * model.period, every * fine + 1)
    states, _ = integrate(model, 0.0, y, t[-1], rtol / 10, t)
    result = record(model, t, states)
    return statistics(t, result["normal"], result["flank"]) | found | {"record": result}


def main() -> None:
    parser = argparse.ArgumentParser(
        description="Steady states of the spur transmission, from its differential equation."
    )
    parser.add_argument("--cases", default="ABCD", help="letters of the cases (default ABCD)")
    parser.add_argument("--damping", nargs="+", default=["ALWAYS", "CONTACT"])
    parser.add_argument(
        "--periods", type=int, default=100, help="tooth periods measured where no orbit attracts"
    )
    parser.add_argument("--X", type=float, help="amplitude of the transmission error, in")
    parser.add_argument("--torque", type=float, help="T, moment about +z on disc 2 (default 945.8)")
    parser.add_argument("--simple", action="store_true", help="supports without the frame's rotation")
    args = parser.parse_args()
    print("normal force, lbf; shares of time: leading flank / gap / other flank; lines Hz:lbf")
    amplitude = {}
    for case in args.cases.upper():
        for law in args.damping if CASES[case].b else ["ALWAYS"]:
            s = steady(case, law, args.periods, X=args.X, torque=args.torque, frame=not args.simple)
            amplitude.setdefault(case, s["amplitude"])
            share = "/".join(f"{s['share'][k]:.3f}" for k in (1, 0, -1))
            peaks = " ".join(f"{hz:.0f}:{a:.0f}" for hz, a in s["peaks"][:4])
            print(
                f"{case} {law:8s} mean {s['mean']:9.2f}  amplitude {s['amplitude']:10.2f}  "
                f"rms {s['rms']:9.2f}  min {s['minimum']:10.1f}  max {s['maximum']:9.1f}  {share}  {peaks}"
            )
            kind = "no short period"
            if "multiplier" in s:
                kind = f"repeats after {s['tooth_periods']} tooth periods, multiplier {s['multiplier']:.5f}"
            print("   ", kind, flush=True)
    for low, high in (("A", "B"), ("A", "C"), ("B", "D")):
        if low in amplitude and high in amplitude:
            print(f"{high}/{low} amplitude ratio {amplitude[high] / amplitude[low]:.4f}")


if __name__ == "__main__":
    main()
