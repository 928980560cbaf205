"""State for ParaView: the debonding bead, cut through its middle, without broken cells, moved by its displacement.

    in ParaView (5.11 and later): File, Load State, this file
    without a window: pvpython --force-offscreen-rendering paraview_state.py [RESULTS [PICTURE.png]]

RESULTS is the folder of a run of this case, by default `results` beside this file, with fields.pvd, or fields.vtkhdf
(`output.format`; ParaView from 5.12 on). Colours: damage of the cells. The pipeline: Clip (plane y = 0 through the axis of the bead), Threshold (damage up to 0.95), Warp By Vector
(displacement at the points, true to scale).
"""
import os
import sys

from paraview.simple import *  # ParaView's own states begin so

try:
    here = os.path.dirname(os.path.abspath(__file__))
except NameError:  # run from ParaView's window without a file
    here = os.getcwd()
arguments = sys.argv[1:]
results = arguments[0] if arguments else os.path.join(here, "results")
picture = arguments[1] if len(arguments) > 1 else None
frames, one_file = (os.path.join(results, name) for name in ("fields.pvd", "fields.vtkhdf"))
if os.path.exists(frames):
    run = PVDReader(registrationName="run", FileName=frames)
elif os.path.exists(one_file):
    if GetParaViewVersion() < (5, 12):
        sys.exit(f"{one_file}: ParaView {GetParaViewVersion()} knows no steps in such files; 5.12 does, and "
                 "output.format = \"vtu\" suits all")
    run = VTKHDFReader(registrationName="run", FileName=one_file)
else:
    sys.exit(f"{frames} does not exist: ./pfdm run cases/glass_bead_quick makes it")
times = list(run.TimestepValues) or [0.0]  # the reader of VTKHDF gives none of a single frame
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
run.UpdatePipeline(times[-1])
box = run.GetDataInformation().GetBounds()
middle = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2]

half = Clip(registrationName="half", Input=run, ClipType="Plane", Crinkleclip=1)
half.ClipType.Origin = middle
half.ClipType.Normal = [0.0, -1.0, 0.0]
sound = Threshold(registrationName="sound cells", Input=half, Scalars=["CELLS", "damage"])
sound.ThresholdMethod = "Below Lower Threshold"
sound.LowerThreshold = 0.95
moved = WarpByVector(registrationName="as it has moved", Input=sound, Vectors=["POINTS", "displacement"])
moved.ScaleFactor = 1.0

view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [900, 900]
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.OrientationAxesLabelColor = [0.0, 0.0, 0.0]
shown = Show(moved, view)
ColorBy(shown, ("CELLS", "damage"))
colours = GetColorTransferFunction("damage")
colours.ApplyPreset("Viridis (matplotlib)", True)
colours.RescaleTransferFunction(0.0, 0.95)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle, bar.RangeLabelFormat = "damage", "", "%.2f"
bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
scene.AnimationTime = times[-1]
view.CameraParallelProjection = 1
view.CameraPosition = [middle[0], middle[1] - 10 * (box[3] - box[2]), middle[2]]
view.CameraFocalPoint = middle
view.CameraViewUp = [0.0, 0.0, 1.0]
ResetCamera(view)
Render(view)
if picture:
    SaveScreenshot(picture, view)
