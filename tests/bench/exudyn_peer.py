# SPDX-License-Identifier: BSD-3-Clause
"""The models of paired_models.py in Exudyn. A process of its own, started by against_exudyn.py with a JSON
object: model, steps, span, intervals, scheme (of exudyn.DynamicSolverType), kept (modified Newton), lie
(rotation vectors in place of Euler parameters), solver (of exudyn.LinearSolverType), tolerance (relative, of
its iterations; none: its default). Prints RESULT and JSON: seconds of processor time of the solution alone,
and for each instant displacements and velocities of the measured bodies, three and three each.

Contacts and the cam's lift are symbolic user functions: Exudyn evaluates them without Python."""

import json
import sys
import time
import warnings

warnings.simplefilter("ignore")
sys.exudynFast = True  # the module without checks of ranges

import exudyn as exu  # noqa: E402
import numpy as np  # noqa: E402
import paired_models as models  # noqa: E402
from exudyn.utilities import (  # noqa: E402
    CartesianSpringDamper,
    CreateSymbolicUserFunction,
    MarkerBodyRigid,
    ObjectGround,
    RigidBodyInertia,
    SensorBody,
)

symbol = exu.symbolic


class Peer:
    def __init__(self, lie: bool) -> None:
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.ground = self.system.AddObject(ObjectGround())
        self.node = {"nodeType": exu.NodeType.RotationRotationVector} if lie else {}
        self.functions: list = []  # must live as long as the system

    def body(self, mass: float, inertia, at, **more):
        return self.system.CreateRigidBody(
            inertia=RigidBodyInertia(mass=mass, inertiaTensor=np.diag(inertia)),
            referencePosition=list(at),
            **more,
            **self.node,
        )

    def slide(self, body: int, at, axis) -> None:
        self.system.CreatePrismaticJoint(
            bodyNumbers=[self.ground, body], position=list(at), axis=axis, show=False
        )

    def between(self, first, second, function, **more) -> None:
        """A force along y between points (body, place on it) by time, distance along y and its rate."""

        def force(mbs, t, item, u, v, k, d, o):
            return symbol.Vector([symbol.Real(0), function(t, u[1], v[1]), symbol.Real(0)])

        marks = [
            self.system.AddMarker(MarkerBodyRigid(bodyNumber=b, localPosition=p)) for b, p in (first, second)
        ]
        if function is not None:
            kind = "ObjectConnectorCartesianSpringDamper"
            self.functions.append(
                CreateSymbolicUserFunction(self.system, force, "springForceUserFunction", itemTypeName=kind)
            )
            more["springForceUserFunction"] = self.functions[-1]
        self.system.AddObject(CartesianSpringDamper(markerNumbers=marks, **more))


def top(peer: Peer, _: int) -> list:
    spin = [0, 150, -4.61538]
    body = peer.body(
        15,
        [0.234375, 0.46875, 0.234375],
        [0, 1, 0],
        gravity=[0, 0, -9.81],
        initialAngularVelocity=spin,
        initialVelocity=list(np.cross(spin, [0, 1, 0])),
    )
    peer.system.CreateSphericalJoint(bodyNumbers=[peer.ground, body], position=[0, 0, 0], show=False)
    return [body]


def chain(peer: Peer, links: int) -> list:
    before = peer.ground
    for i in range(links):
        body = peer.body(1, models.LINK_INERTIA, [i + 0.5, 0, 0], gravity=[0, 0, -models.GRAVITY])
        peer.system.CreateRevoluteJoint(
            bodyNumbers=[before, body],
            position=[i, 0, 0],
            axis=models.axis(i),
            show=False,
        )
        before = body
    return [before]


def slider_crank(peer: Peer, _: int) -> list:
    c = models.Crank
    pull = {"gravity": [0, -models.GRAVITY, 0]}
    spin, along = c.first_velocities()
    crank = peer.body(c.masses[0], c.inertias[0], [0, 0, 0], initialAngularVelocity=[0, 0, c.speed], **pull)
    rod = peer.body(
        c.masses[1],
        c.inertias[1],
        (c.pin + c.end) / 2,
        initialAngularVelocity=list(spin),
        initialVelocity=list(np.array([along, 0, 0]) + np.cross(spin, (c.pin - c.end) / 2)),
        **pull,
    )
    slider = peer.body(c.masses[2], c.inertias[2], c.end, initialVelocity=[along, 0, 0], **pull)
    s = peer.system
    s.CreateRevoluteJoint(
        bodyNumbers=[peer.ground, crank], position=[0, 0, 0], axis=[0, 0, 1], useGlobalFrame=True, show=False
    )
    s.CreateSphericalJoint(bodyNumbers=[crank, rod], position=list(c.pin), show=False)
    y, z = np.array([0.0, 1.0, 0.0]), c.cross / np.linalg.norm(c.cross)
    s.CreateGenericJoint(  # universal: y of the slider stays across z of the rod
        bodyNumbers=[slider, rod],
        position=list(c.end),
        rotationMatrixAxes=np.column_stack([np.cross(y, z), y, z]),
        constrainedAxes=[1, 1, 1, 1, 0, 0],
        show=False,
    )
    peer.slide(slider, c.end, [1, 0, 0])
    return [rod, slider]


def valve_train(peer: Peer, _: int) -> list:
    v = models.Valves
    down, lever, valve_down = v.first_displacements()
    tappet = peer.body(v.tappet_mass, v.small, [0, v.base, 0], initialDisplacement=[0, -down, 0])
    turn = np.array([[np.cos(lever), np.sin(lever), 0], [-np.sin(lever), np.cos(lever), 0], [0, 0, 1]])
    rocker = peer.body(v.rocker_mass, [v.rocker_inertia] * 3, v.pivot, initialRotationMatrix=turn)
    valve = peer.body(v.valve_mass, v.small, [v.valve, v.base, 0], initialDisplacement=[0, -valve_down, 0])
    s = peer.system
    for body, x in ((tappet, 0), (valve, v.valve)):
        peer.slide(body, [x, v.base, 0], [0, 1, 0])
    s.CreateRevoluteJoint(
        bodyNumbers=[peer.ground, rocker],
        position=list(v.pivot),
        axis=[0, 0, 1],
        show=False,
    )

    def push(gap, rate):  # on the second point, against the first
        zero = symbol.Real(0)
        return symbol.IfThenElse(gap < 0, -symbol.max(zero, -v.stiffness * gap - v.damping * rate), zero)

    def clamped(x):
        return symbol.max(symbol.Real(0), symbol.min(symbol.Real(1), x))

    def on_cam(t, place, rate):
        turn = v.speed * t - v.phase
        up, back = clamped(turn / v.rise), clamped((turn - v.rise - v.dwell) / v.rise)
        lift = v.lift * (models.poly345(up) - models.poly345(back))
        lift_rate = v.lift / v.rise * v.speed * (models.poly345_slope(up) - models.poly345_slope(back))
        return push(place - v.base - lift, rate - lift_rate)

    def on_pad(t, place, rate):
        return push(place - v.pad, rate)

    peer.between((peer.ground, [0, 0, 0]), (tappet, [0, 0, 0]), on_cam)
    peer.between((tappet, [0, 0, 0]), (rocker, [-v.pivot[0], 0, 0]), on_pad)
    peer.between((valve, [0, 0, 0]), (rocker, [v.valve - v.pivot[0], 0, 0]), on_pad)
    peer.between(
        (peer.ground, [v.valve, v.base, 0]),
        (valve, [0, 0, 0]),
        None,
        stiffness=[0, v.spring, 0],
        offset=[0, v.preload / v.spring, 0],
    )
    return [tappet, valve]


def main() -> None:
    job = json.loads(sys.argv[1])
    name = job["model"]
    peer = Peer(job["lie"])
    build = {"top": top, "crank": slider_crank, "valves": valve_train}.get(name, chain)
    bodies = build(peer, models.links(name))
    kinds = (exu.OutputVariableType.Displacement, exu.OutputVariableType.Velocity)
    sensors = [
        peer.system.AddSensor(
            SensorBody(bodyNumber=body, writeToFile=False, storeInternal=True, outputVariableType=kind)
        )
        for body in bodies
        for kind in kinds
    ]
    peer.system.Assemble()
    s = exu.SimulationSettings()
    s.timeIntegration.numberOfSteps, s.timeIntegration.endTime = job["steps"], job["span"]
    s.timeIntegration.generalizedAlpha.spectralRadius = models.RHO
    s.timeIntegration.newton.useModifiedNewton = job["kept"]
    if job.get("tolerance"):
        s.timeIntegration.newton.relativeTolerance = job["tolerance"]
    s.solutionSettings.writeSolutionToFile = False
    s.solutionSettings.sensorsWritePeriod = job["span"] / job["intervals"]
    s.parallel.numberOfThreads = 1
    s.linearSolverType = getattr(exu.LinearSolverType, job["solver"])
    begun = time.process_time()
    peer.system.SolveDynamic(s, solverType=getattr(exu.DynamicSolverType, job["scheme"]))
    seconds = time.process_time() - begun
    rows = np.hstack([peer.system.GetSensorStoredData(sensor)[:, 1:] for sensor in sensors])
    print("RESULT", json.dumps([seconds, rows.tolist()]))


if __name__ == "__main__":
    main()
