#include "engine/measure/fields/field_record.hpp"

#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

std::vector<double> settings_of(const Scene& scene, const FieldTimes& times) {
    const FieldOutput& fields = scene.output.fields;
    return {kernel_width(fields.width, 0.5 * largest_diameter(scene)),
            static_cast<double>(fields.grid),
            static_cast<double>(fields.kernel),
            fields.width,
            fields.cell,
            static_cast<double>(times.record),
            times.first,
            times.every,
            static_cast<double>(times.phases)};
}

template <class Each>
void for_each_grid(CoarseFields& fields, const Each& each) {
    each(fields.density);
    for (CellValues& values : fields.solid_fraction) each(values);
    for (CellValues& values : fields.velocity) each(values);
    each(fields.temperature);
    for (CellValues& values : fields.kinetic_stress) each(values);
    for (CellValues& values : fields.contact_stress) each(values);
}

}  // namespace

FieldRecord::FieldRecord(const Scene& scene, const FieldTimes& times)
    : times_(times), settings_(settings_of(scene, times)), sums_(scene, static_cast<int>(times.phases)) {}

void FieldRecord::start(std::int64_t step, const FieldState& state) {
    sums_.clear();
    open_ = step == 0;
    gather(step, state);
}

void FieldRecord::gather(std::int64_t step, const FieldState& state) {
    ended_ = times_.ends_record(step);
    if (ended_) {
        if (open_ && sums_.moments() > 0) last_ = sums_.mean();
        sums_.clear();
        open_ = true;
    }
    if (open_ && times_.is_moment(step)) sums_.add(state, static_cast<int>(times_.phase_of(step)));
}

void FieldRecord::save(std::ostream& out) const {
    write_vector(out, settings_);
    write_value(out, static_cast<std::int32_t>(open_));
    write_value(out, static_cast<std::int32_t>(ended_ && last_));
    if (ended_ && last_) {
        CoarseFields last = *last_;
        for_each_grid(last, [&](const CellValues& values) { write_vector(out, values); });
    }
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
    std::int32_t open = 0, ended = 0;
    read_value(in, open);
    read_value(in, ended);
    if ((open != 0 && open != 1) || (ended != 0 && ended != 1)) in.fail();
    open_ = open == 1;
    ended_ = ended == 1;
    if (ended_) load_last(in);
    sums_.load(in);
}

void FieldRecord::load_last(Bytes& in) {
    const auto cells = static_cast<std::size_t>(sums_.grid().cells());
    CoarseFields last;
    last.solid_fraction.resize(sums_.species());
    last.velocity.resize(3);
    last.kinetic_stress.resize(6);
    last.contact_stress.resize(9);
    for_each_grid(last, [&](CellValues& values) {
        read_vector(in, values);
        if (values.size() != cells) in.fail();
    });
    last_ = std::move(last);
}

}  // namespace grainreel
