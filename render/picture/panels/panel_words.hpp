// The words and plots around panels that stand side by side. Words are blocks that flow in rows; some change
// with time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/panels/panels.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/picture/words/blocks.hpp"

namespace grainreel {

struct WordBlock {
    using Draw =
        std::function<void(const Writer&, double x, double y, const Shot&, const std::string& playback)>;
    TextSize size;
    bool changes = false;
    Draw draw;
    double x = 0, y = 0;  // pixels: the top left corner, which flow() sets
};

// The blocks that hold for all panels: captions (film.caption), clock, dial, drive, exaggeration, speed of
// playback, legend, colour bar, what marks mean, and scale bar. scale: pixels a metre; 0 where panels have
// scales of their own. whole: the film of the whole picture.
std::vector<WordBlock> common_blocks(const Writer& measure, const std::vector<Panel>& panels,
                                     const Common& common, double scale, const Film& whole);

// Puts blocks in rows across the width. Returns the height that they take with their margins.
double flow(std::vector<WordBlock>& blocks, const TypeScale& type, double width);

// The words under one panel that change with the frames: its note, and the caption that is shown.
std::string panel_note(const FilmedScene& scene, const Shot& frame);
// Texts about as long as these get.
std::vector<std::string> longest_panel_notes(const FilmedScene& scene);
constexpr int panel_note_lines = 6;  // lines that each line of them may take

// The height of the notes under panels of this width: words that change with the frames. 0 without notes.
double notes_height(const Writer& measure, const std::vector<Panel>& panels, double width);

// Each panel may have a caption of time: words over it that tell how fast its film plays. Returns the height
// of these captions; 0 where one caption of time holds for all panels.
double pace_height(const Writer& measure, const std::vector<Panel>& panels, const Common& common,
                   double width);
// Writes the caption of time over one panel.
TextSize pace_block(const Writer& writer, const std::string& words, double width);
// Writes a panel's caption: a first line in larger bold letters, and the other lines below it.
TextSize caption_block(const Writer& writer, const std::string& caption, double width);
// Writes a text whose lines stand in the middle of the width.
TextSize write_in_middle(const Writer& writer, const std::string& text, const TextStyle& style,
                         const Colour& colour, double width, int lines);

// The height of a panel's foot: legend, scale bar, colour bar and the meaning of marks, where these belong to
// one panel alone. scales: whether each panel has a scale bar.
double foot_height(const Writer& measure, const std::vector<Panel>& panels, const Common& common, bool scales,
                   double width);
// Writes the foot. scale: pixels a metre in the panel. bar: whether there is a scale bar.
void draw_foot(const Writer& writer, const Panel& panel, const Common& common, double scale, bool bar,
               double width);

// The plots of panels that stand side by side. Plots of the same quantity show the same span of values and of
// time, so that their curves can be compared.
class PanelPlots {
  public:
    // Makes as many plots as the layout has places for.
    PanelPlots(const std::vector<Panel>& panels, const PanelLayout& layout, const TypeScale& type,
               const Palette& palette);

    // Takes one frame for each panel. Returns whether anything changed.
    bool take(const std::vector<ShotPtr>& frames);
    struct Placed {
        std::unique_ptr<SidePlot> plot;
        std::string quantity;
        Rectangle place;    // pixels of the whole picture
        std::size_t panel;  // number of the panel that it belongs to
    };
    std::vector<Placed>& all() { return plots_; }

  private:
    void share_limits();
    std::vector<Placed> plots_;
};

}  // namespace grainreel
