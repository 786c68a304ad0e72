#include "engine/scene/chapters/turn_keys.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/scene/chapters/chapters.hpp"

namespace grainreel {

using namespace keys;

const KeyTable<BodyTurn>& turn_table() {
    using T = BodyTurn;
    static const KeyTable<T> table{
        vector("axis", &T::axis, Dimension::number, required(),
               "Along the axis, any length; turns by the right-hand rule."),
        vector("through", &T::through, Dimension::length, initial(), "A point of the axis, in the scene."),
        quantity("rate", &T::rate, Dimension::spin, any, required(),
                 "How fast: \"30 rpm\", \"2 rad/s\", \"90 degree/s\"; below 0 the other way round."),
        quantity("from", &T::from, Dimension::time, not_negative, literal("\"0 s\""),
                 "When it begins, since the start of the run."),
        quantity("over", &T::over, Dimension::time, not_negative, literal("\"0 s\""),
                 "How long the rate takes to rise, as the drive's ramp does, and to fall; 0: at once."),
        quantity("until", &T::until, Dimension::time, positive, note("the run's end"),
                 "When it begins to end.")
            .unwritten_if([](const T& turn) { return std::isinf(turn.until); }),
    };
    return table;
}

BodyTurn read_turn(Document& document, const Scene& scene, const std::string& path) {
    if (!document.is_table(path))
        document.fail(path, fmt::format("is {}; write {{ axis = [0, 1, 0], rate = \"30 rpm\" }}",
                                        document.written_value(path)));
    BodyTurn turn;
    turn_table().read(document, scene, path, turn);
    make_unit(document, path + ".axis", turn.axis);
    if (clearly_less(turn.until, turn.from + turn.over))
        document.fail(path + ".until",
                      fmt::format("is {:.6g} s, but the turn has begun wholly at {:.6g} s only; raise it, or "
                                  "shorten 'over'",
                                  turn.until, turn.from + turn.over));
    return turn;
}

}  // namespace grainreel
