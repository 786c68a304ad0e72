#include "engine/measure/fields/field_record.hpp"

namespace grainreel {

FieldRecord::FieldRecord(const Scene& scene, const FieldTimes& times)
    : times_(times), sums_(scene, static_cast<int>(times.phases)) {}

void FieldRecord::start(std::int64_t step, const FieldState& state) {
    sums_.clear();
    open_ = step == 0;
    gather(step, state);
}

void FieldRecord::gather(std::int64_t step, const FieldState& state) {
    if (times_.ends_record(step)) {
        if (open_ && sums_.moments() > 0) last_ = sums_.mean();
        sums_.clear();
        open_ = true;
    }
    if (open_ && times_.is_moment(step)) sums_.add(state, static_cast<int>(times_.phase_of(step)));
}

void FieldRecord::save(std::ostream& out) const {
    write_value(out, static_cast<std::int32_t>(open_));
    sums_.save(out);
}

void FieldRecord::load(Bytes& in) {
    std::int32_t open = 0;
    read_value(in, open);
    if (open != 0 && open != 1) in.fail();
    open_ = open == 1;
    sums_.load(in);
}

}  // namespace grainreel
