# SPDX-License-Identifier: BSD-3-Clause
"""Opens a result with each of ParaView's three XDMF readers; on demand: it needs Debian's paraview and xvfb.

xvfb-run -a pvpython tests/verify/paraview_readers.py "$PWD/bevel_pair.xdmf"
"""

import sys

from paraview import simple


def look(reader_class, path: str) -> str:
    try:
        reader = reader_class(FileNames=[path])
    except AttributeError:  # the newer two call it so
        reader = reader_class(FileName=[path])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    reader.UpdatePipeline(times[-1])
    points = reader.GetPointDataInformation()
    names = [points.GetArray(i).Name for i in range(points.GetNumberOfArrays())]
    largest = points.GetArray("displacement").GetRange(-1)[1]
    return f"{len(times)} frames to t = {times[-1]:g}, {', '.join(names)}; largest displacement {largest:g}"


def main() -> int:
    status = 0
    for name in ("XDMFReader", "Xdmf3ReaderS", "Xdmf3ReaderT"):
        try:
            print(f"{name}: {look(getattr(simple, name), sys.argv[1])}")
        except Exception as error:
            print(f"{name}: {error!r}")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
