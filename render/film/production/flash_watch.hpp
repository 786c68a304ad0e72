// Finds out whether a film flashes more often than three times a second, which can set off seizures: the
// general flash threshold of WCAG 2.2, success criterion 2.3.1. A flash is a pair of opposing changes of the
// relative luminance by 0.1 or more, the darker side being below 0.8. It counts if a quarter of a window
// flashes in the same second, place by place. A window is as wide as a third of the picture and as high as a
// third of it (10 degrees of the visual field). Places of opposite phase count together: a chequerboard
// whose fields change sides is no less dangerous. In a loose bed that is seen once a period, some places
// change from picture to picture, but few of them change back and forth more than three times a second.
#pragma once

#include <array>
#include <deque>
#include <optional>

#include "render/picture/base/picture.hpp"

namespace grainreel {

class FlashWatch {
  public:
    explicit FlashWatch(double rate) : rate_(rate) {}  // frames a second of the film

    void add(const Picture& picture);
    // Time in s of film at which the flashing first became too much; empty when it never did.
    std::optional<double> too_much_at() const { return at_; }

  private:
    static constexpr int kAcross = 24, kDown = 18;  // the picture is divided into so many places
    static constexpr int kWide = kAcross / 3, kHigh = kDown / 3;                     // places in a window
    static constexpr int kColumns = kAcross - kWide + 1, kRows = kDown - kHigh + 1;  // number of windows

    struct Place {
        double low = 0, high = 0;  // lowest and highest luminance since the last change
        int direction = 0;         // direction of that change: 1 up, -1 down, 0 none yet
        std::deque<double> turns;  // s, times of the changes in the last second
    };
    void take(Place& place, double luminance, double now) const;
    int flashing_in(int column, int row) const;

    const double rate_;
    long frames_ = 0;
    std::array<Place, kAcross * kDown> places_;
    std::optional<double> at_;
};

}  // namespace grainreel
