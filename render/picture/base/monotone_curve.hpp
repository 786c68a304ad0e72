// A smooth curve through points that never overshoots them: between two of them it stays between their
// values.
#pragma once

#include <cstddef>
#include <vector>

namespace grainreel {

// Cubic pieces with the slopes of Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300: a weighted
// harmonic mean of the secants, zero at a turning point. Flat before the first point and after the last, and
// with slope zero there, so that it sets out and arrives gently.
class MonotoneCurve {
  public:
    // times: strictly rising, as many as values, at least one.
    MonotoneCurve(std::vector<double> times, std::vector<double> values);
    double at(double time) const;

  private:
    std::vector<double> times_, values_, slopes_;
};

}  // namespace grainreel
