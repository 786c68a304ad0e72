// Finds out whether a film flashes more often than three times a second, which can set off seizures: the
// general flash threshold of WCAG 2.2, success criterion 2.3.1. A flash is a pair of opposing changes of the
// relative luminance by 0.1 or more, the darker side being below 0.8. It counts where a quarter of a window
// of a third of the picture each way (10 degrees of the visual field) changes in one direction at the same
// time. Parts that change in the other direction then are subtracted: grains that only change places make
// some places brighter and as many darker, and the window as a whole does not flash.
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
    static constexpr int kAcross = 24, kDown = 18;                                   // places in the picture
    static constexpr int kWide = kAcross / 3, kHigh = kDown / 3;                     // places in a window
    static constexpr int kColumns = kAcross - kWide + 1, kRows = kDown - kHigh + 1;  // number of windows

    struct Place {
        double low = 0, high = 0;  // lowest and highest luminance since the last change
        int direction = 0;         // direction of that change: 1 up, -1 down, 0 none yet
        double turned = -1;        // s, time of that change
    };
    struct Window {
        int direction = 0;
        std::deque<double> turns;  // s, times of the changes in the last second
    };
    void take(Place& place, double luminance, double now) const;
    int turning(int column, int row, double now) const;

    const double rate_;
    long frames_ = 0;
    std::array<Place, kAcross * kDown> places_;
    std::array<Window, kColumns * kRows> windows_;
    std::optional<double> at_;
};

}  // namespace grainreel
