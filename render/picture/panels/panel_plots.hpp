// The plots under panels that stand side by side. Those of one quantity have one span of values and of time,
// so that their curves can be compared.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/picture/panels/panels.hpp"
#include "render/picture/plots/side_plot.hpp"

namespace grainreel {

class PanelPlots {
  public:
    // As many as the layout has places for.
    PanelPlots(const std::vector<Panel>& panels, const PanelLayout& layout, const TypeScale& type,
               const Palette& palette);

    // Takes one frame a panel. False when nothing changed.
    bool take(const std::vector<FramePtr>& frames);
    struct Placed {
        std::unique_ptr<SidePlot> plot;
        std::string quantity;
        Rectangle place;    // in the picture
        std::size_t panel;  // of its own
    };
    std::vector<Placed>& all() { return plots_; }

  private:
    void share_limits();
    std::vector<Placed> plots_;
};

}  // namespace grainreel
