#!/usr/bin/env python3
"""The last moment of what `export --to vtk` made, as ParaView draws it. Usage: pvbatch paraview.py FOLDER PICTURE."""
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetAnimationScene, GetColorTransferFunction, Glyph, OpenDataFile,
                             Render, ResetCamera, SaveScreenshot, Show)

folder, picture = sys.argv[1], sys.argv[2]
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [640, 480]
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
grains = OpenDataFile(folder + "/grains.pvd")
walls = OpenDataFile(folder + "/walls.pvd")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().GoToLast()
balls = Glyph(Input=grains, GlyphType="Sphere")
balls.ScaleArray = ["POINTS", "radius"]
balls.ScaleFactor = 2
balls.GlyphMode = "All Points"
balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 24
shown = Show(balls, view)
ColorBy(shown, ("POINTS", "force", "Magnitude"))
shown.RescaleTransferFunctionToDataRange(False)
shown.SetScalarBarVisibility(view, True)
GetColorTransferFunction("force").ApplyPreset("Viridis (matplotlib)", True)
glass = Show(walls, view)
glass.Opacity = 0.2
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [1, -0.6, 0.4], [0, 0, 0], [0, 0, 1]
ResetCamera(view)
Render(view)
SaveScreenshot(picture, view)
