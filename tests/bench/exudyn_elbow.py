# SPDX-License-Identifier: BSD-3-Clause
"""The elbow of beam_cost.py in Exudyn: a process of its own, given a JSON object with elements (of a leg),
step, span, instants, kept (modified Newton). Prints RESULT and JSON: seconds of processor time of the
solution alone, and the tip's displacements, three for each instant.

Beams are Exudyn's geometrically exact ones of two nodes, on nodes with rotation vectors on the Lie group;
Newton's method with a sparse solver stops at a residual of 1e-5 of the first."""

import json
import sys
import time
import warnings
from itertools import pairwise

warnings.simplefilter("ignore")
sys.exudynFast = True  # the module without checks of ranges

import exudyn as exu  # noqa: E402
import numpy as np  # noqa: E402
from exudyn.utilities import (  # noqa: E402
    CreateSymbolicUserFunction,
    GenericJoint,
    LoadForceVector,
    MarkerBodyRigid,
    MarkerNodeRigid,
    NodeRigidBodyRotVecLG,
    ObjectBeamGeometricallyExact,
    ObjectGround,
    SensorNode,
)

LENGTH = 10.0


def leg(system, start, direction, turn: float, elements: int) -> list[int]:
    section = exu.BeamSection()
    section.stiffnessMatrix = np.diag([1e6, 1e6, 1e6, 1e3, 1e3, 1e3])
    section.inertia = np.diag([20.0, 10.0, 10.0])
    section.massPerLength = 1.0
    nodes = [
        system.AddNode(
            NodeRigidBodyRotVecLG(
                referenceCoordinates=[*(np.array(start) + LENGTH * u * np.array(direction)), 0, 0, turn]
            )
        )
        for u in np.linspace(0, 1, elements + 1)
    ]
    for a, b in pairwise(nodes):
        system.AddObject(
            ObjectBeamGeometricallyExact(nodeNumbers=[a, b], length=LENGTH / elements, sectionData=section)
        )
    return nodes


def main() -> None:
    ask = json.loads(sys.argv[1])
    container = exu.SystemContainer()
    system = container.AddSystem()
    ground = system.AddObject(ObjectGround())
    first = leg(system, [0, 0, 0], [1, 0, 0], 0, ask["elements"])
    second = leg(system, [LENGTH, 0, 0], [0, 1, 0], np.pi / 2, ask["elements"])
    root = system.AddMarker(MarkerNodeRigid(nodeNumber=first[0]))
    wall = system.AddMarker(MarkerBodyRigid(bodyNumber=ground))
    system.AddObject(GenericJoint(markerNumbers=[wall, root], constrainedAxes=[1] * 6))
    corner = [system.AddMarker(MarkerNodeRigid(nodeNumber=n)) for n in (first[-1], second[0])]
    quarter = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
    system.AddObject(GenericJoint(markerNumbers=corner, constrainedAxes=[1] * 6, rotationMarker1=quarter))

    def push(mbs, t, load):
        zero = exu.symbolic.Real(0)
        rise = exu.symbolic.IfThenElse(t < 1, t, exu.symbolic.IfThenElse(t < 2, 2 - t, zero))
        return exu.symbolic.Vector([zero, zero, rise * 50])

    load = LoadForceVector(markerNumber=corner[0], loadVector=[0, 0, 0])
    load.loadVectorUserFunction = CreateSymbolicUserFunction(
        system, push, "loadVectorUserFunction", itemTypeName="LoadForceVector"
    )
    system.AddLoad(load)
    tip = system.AddSensor(
        SensorNode(
            nodeNumber=second[-1], outputVariableType=exu.OutputVariableType.Displacement, storeInternal=True
        )
    )
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(ask["span"] / ask["step"])
    settings.timeIntegration.endTime = ask["span"]
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    settings.timeIntegration.newton.useModifiedNewton = ask["kept"]
    settings.timeIntegration.newton.relativeTolerance = 1e-5
    settings.timeIntegration.newton.absoluteTolerance = 1e-7
    settings.linearSolverType = exu.LinearSolverType.EigenSparse
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = ask["span"] / ask["instants"]
    settings.timeIntegration.verboseMode = 0
    begun = time.process_time()
    system.SolveDynamic(settings)
    seconds = time.process_time() - begun
    rows = system.GetSensorStoredData(tip)
    instants = np.linspace(0, ask["span"], ask["instants"] + 1)
    picked = [rows[np.argmin(abs(rows[:, 0] - t)), 1:].tolist() for t in instants]
    print("RESULT", json.dumps({"seconds": seconds, "tip": picked}))


main()
