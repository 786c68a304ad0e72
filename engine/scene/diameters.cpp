#include "engine/scene/diameters.hpp"

namespace grainreel {

double draw_diameter(const SizeSpread& spread, Random& random) {
    switch (spread.kind) {
        case SizeSpread::Kind::fixed:
            return spread.largest;
        case SizeSpread::Kind::uniform:
            return random.between(spread.smallest, spread.largest);
        case SizeSpread::Kind::normal:
            break;
    }
    for (;;) {
        const double d = spread.mean + spread.deviation * random.normal();
        if (d >= spread.smallest && d <= spread.largest) return d;
    }
}

}  // namespace grainreel
