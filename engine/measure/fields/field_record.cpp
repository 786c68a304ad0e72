#include "engine/measure/fields/field_record.hpp"

namespace grainreel {

namespace {

std::vector<double> settings_of(const FieldOutput& fields, const FieldTimes& times) {
    return {static_cast<double>(fields.grid),
            static_cast<double>(fields.kernel),
            fields.width,
            fields.cell,
            static_cast<double>(times.record),
            times.first,
            times.every,
            static_cast<double>(times.phases)};
}

}  // namespace

FieldRecord::FieldRecord(const Scene& scene, const FieldTimes& times)
    : times_(times),
      settings_(settings_of(scene.output.fields, times)),
      sums_(scene, static_cast<int>(times.phases)) {}

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
    write_vector(out, settings_);
    write_value(out, static_cast<std::int32_t>(open_));
    sums_.save(out);
}

void FieldRecord::load(Bytes& in) {
    std::vector<double> settings;
    read_vector(in, settings);
    if (settings != settings_) {
        std::vector<char> others(in.left());
        in.read(others.data(), others.size());
        open_ = false;
        return;
    }
    std::int32_t open = 0;
    read_value(in, open);
    if (open != 0 && open != 1) in.fail();
    open_ = open == 1;
    sums_.load(in);
}

}  // namespace grainreel
