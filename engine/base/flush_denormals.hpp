// Numbers too small for full precision count as zero while this lives: a processor takes a hundred times as
// long over them, and grains at rest make many, in single precision above all.
#pragma once

#include <xmmintrin.h>

namespace grainreel {

class FlushDenormals {
  public:
    FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | results_to_zero | inputs_to_zero); }
    ~FlushDenormals() { _mm_setcsr(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    static constexpr unsigned results_to_zero = 0x8000, inputs_to_zero = 0x0040;
    unsigned before_;
};

}  // namespace grainreel
