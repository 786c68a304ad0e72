// Draws the last frame of a run, or of a file with frames, to PNG, by what reads files and what draws:
//     draw_frame output/mine picture.png
