// Several scenes beside each other in one picture: what they have in common, where each goes, and how large
// a metre is.
#pragma once

#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Panel {
    FilmedScene scene;  // with its own camera, and what its film shows; of its film nothing else counts
    std::string caption;
    std::vector<std::string> playback = {};  // what is said of time in each segment of the whole
};

// Kinds of what is drawn over the grains, and has to be explained.
struct MarkKinds {
    bool arrows = true, streamlines = true, wall_forces = true;
    bool trails = true, chains = true, rings = true;
};
// With those marks alone.
FilmedScene marked_by(FilmedScene scene, const MarkKinds& kinds);

// What is the same in all panels, and so is said once.
struct Common {
    bool clock = true;  // one frequency, phase and ramp: one dial shows all cycles
    bool frequency = true, g_level = true, amplitude = true;  // of drives that all have
    bool species = true;
    bool exaggerated = true;  // by one factor
    bool colours = true;      // one colour bar, or none
    MarkKinds marks;          // that mean the same; arrows only where a metre is equally long, too
    bool playback = true;
    bool captions = true;  // of time (film.caption), with at least one
};
Common common_of(const std::vector<Panel>& panels);

// Without what is common and written in the panels otherwise: captions of time.
std::vector<Panel> without_common(std::vector<Panel> panels, const Common& common);

// What tells the scenes apart, shortest first: frequency, g level or amplitude of their drives; or their
// titles, with the drives where these differ too; or their names.
std::vector<std::string> captions_of(const std::vector<FilmedScene>& scenes);

// One range of colours for panels that show the same quantity, as wide as the widest of theirs, unless a
// scene has a range of its own: the same colour then means the same everywhere.
void share_colours(std::vector<Panel>& panels);

// One height that the grains reach, the highest of all, for cameras that frame it by themselves: containers
// of the same size are then drawn at the same size, and their floors at the same height but for their
// strokes.
void share_reach(std::vector<Panel>& panels);

struct PanelLayout {
    struct Place {
        Rectangle caption, pace, port, note;  // pace: what is said of time; note: live words
        std::vector<Rectangle> plots;
        Rectangle foot;   // of no height when all is said below
        double zoom = 1;  // of the panel's camera
        int row = 0;
    };
    std::vector<Place> places;  // in rows from the top; empty when the picture is too small for them
    Rectangle top, bottom;      // title; clock, legend, scale
    double scale = 0;           // pixels a metre, in the middle of every panel; 0: each has its own
    bool plots_fit = true;      // else they are left out
};

constexpr int least_panel = 64;  // pixels, either way

// Columns and rows are chosen so that the grains become as large as can be. Containers of which one would be
// too small to see at the others' scale get a scale of their own each.
// Plots stand under the ports or beside them, as far as they leave room for the grains.
// top, bottom, caption, pace, note, foot: pixels, the heights of what is written there.
struct WordHeights {
    double top = 0, bottom = 0, caption = 0, pace = 0, note = 0, foot = 0;
};
TypeScale panel_type(const Film& film);  // upright pictures have smaller words than those of one scene
PanelLayout plan_panels(const std::vector<Panel>& panels, const Film& film, const WordHeights& words);

}  // namespace grainreel
