"""Prints what meshio or ParaView reads of the last frame: TOOL is meshio (with python3) or paraview (with pvpython).

    read_frames.py TOOL FILE

FILE is fields.pvd, for ParaView also fields.vtkhdf. Ends with 77 where the tool is not installed, with 78 where it is too
old for the file.
"""

import pathlib
import sys
import xml.etree.ElementTree


def read_with_meshio(pvd):
    import meshio
    row = xml.etree.ElementTree.parse(pvd).findall(".//DataSet")[-1]
    mesh = meshio.read(pvd.parent / row.get("file"))
    height = mesh.points[:, 2] + mesh.point_data["displacement"][:, 2]
    damage = [value for block in mesh.cell_data["damage"] for value in block]
    regions = sorted(name for name in mesh.field_data if name.startswith("region_"))
    return len(mesh.points), damage, float(mesh.field_data["TimeValue"][0]), regions, height.min(), height.max()


def read_with_paraview(file):
    from paraview import servermanager, simple
    if file.suffix == ".vtkhdf" and simple.GetParaViewVersion() < (5, 12):
        print(f"ParaView {simple.GetParaViewVersion()} knows no steps in {file.name}")
        sys.exit(78)
    reader = (simple.VTKHDFReader if file.suffix == ".vtkhdf" else simple.PVDReader)(FileName=str(file))
    time = reader.TimestepValues[-1]
    reader.UpdatePipeline(time)
    warp = simple.WarpByVector(Input=reader)  # the vectors that it takes by itself
    warp.UpdatePipeline(time)
    bounds = warp.GetDataInformation().GetBounds()
    grid = servermanager.Fetch(reader)
    array = grid.GetCellData().GetArray("damage")
    damage = [array.GetValue(i) for i in range(array.GetNumberOfTuples())]
    names = [grid.GetFieldData().GetArrayName(i) for i in range(grid.GetFieldData().GetNumberOfArrays())]
    regions = sorted(name for name in names if name.startswith("region_"))
    return grid.GetNumberOfPoints(), damage, time, regions, bounds[4], bounds[5]


def main():
    read = {"meshio": read_with_meshio, "paraview": read_with_paraview}[sys.argv[1]]
    try:
        points, damage, time, regions, low, high = read(pathlib.Path(sys.argv[2]))
    except ImportError as error:
        print(error)
        sys.exit(77)
    print(f"{points} points, {len(damage)} cells, damage {sum(damage):g}, time {time:g}, {' '.join(regions)}, "
          f"warped from {low:.6g} to {high:.6g}")


main()
