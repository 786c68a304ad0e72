// Several scenes beside each other in one picture, a panel each: what they have in common (panels.cpp), where
// each of them lies and how large a metre is (panel_grid.cpp).
#pragma once

#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Panel {
    // Its film gives the camera, what is shown, the captions and the look. The whole picture's film gives
    // size and background.
    FilmedScene scene;
    std::string caption;
    std::vector<std::string> playback = {};  // how fast the film plays, in words, for each of its segments
};

// The kinds of marks over the grains that the legend explains.
struct MarkKinds {
    bool arrows = true, streamlines = true, wall_forces = true;
    bool trails = true, chains = true, rings = true;
};
// A copy of the scene in which only these kinds of marks are shown.
FilmedScene marked_by(FilmedScene scene, const MarkKinds& kinds);

// What is the same in all panels and is therefore said once.
struct Common {
    bool clock = true;  // frequency, phase and ramp are equal, so that one dial shows all cycles
    bool frequency = true, g_level = true, amplitude = true;  // all drives agree in this
    bool species = true;
    bool exaggerated = true;  // all motion is exaggerated by one factor
    bool colours = true;      // one colour bar, or none
    MarkKinds marks;          // kinds that mean the same everywhere; all forces also need one scale
    bool playback = true;
    bool captions = true;  // all have the same captions (film.caption), at least one
};
Common common_of(const std::vector<Panel>& panels);

// The panels without their common captions (film.caption), which are not written in each panel.
std::vector<Panel> without_common(std::vector<Panel> panels, const Common& common);

// Words that tell the scenes apart. Where all titles are alike and the drives differ, they are the drives'
// frequency, g level or amplitude. Otherwise they are the titles, with the drives if those differ too. If
// that does not tell the scenes apart, they are the names, and as a last resort the names with numbers.
std::vector<std::string> captions_of(const std::vector<FilmedScene>& scenes);

// Gives panels that show the same quantity one range of colours that holds all of theirs, so that a colour
// means the same in all of them. It does nothing where a scene has a range of its own.
void share_colours(std::vector<Panel>& panels);

// Gives one height, the highest of all, to the cameras that frame what the grains reach. Containers of the
// same size are then drawn at the same size, with their floors at the same height except for their strokes.
void share_reach(std::vector<Panel>& panels);

struct PanelLayout {
    struct Place {
        Rectangle caption, pace, port, note;  // pace: caption of time; note: words that change
        std::vector<Rectangle> plots;
        Rectangle foot;   // has height 0 when everything is written below the panels
        double zoom = 1;  // zoom of the panel's camera
        int row = 0;
    };
    std::vector<Place> places;  // in rows from the top; empty when the picture is too small for them
    Rectangle top, bottom;      // top: title; bottom: clock, legend, scale
    double scale = 0;           // pixels a metre in the middle of every panel; 0: panels differ
    bool plots_fit = true;      // whether there is room for plots; if not, they are left out
};

constexpr int least_panel = 64;  // pixels, width and height

// Pixels: the heights of the words at these places.
struct WordHeights {
    double top = 0, bottom = 0, caption = 0, pace = 0, note = 0, foot = 0;
};
TypeScale panel_type(const Film& film);  // in upright pictures words are smaller than with one scene
// Chooses columns and rows so that the grains become as large as can be. Where a container would be too small
// to see at the scale of the others, each has a scale of its own. Plots stand under the ports or beside them
// if they leave room for the grains.
PanelLayout plan_panels(const std::vector<Panel>& panels, const Film& film, const WordHeights& words);

}  // namespace grainreel
