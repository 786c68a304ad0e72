#include "engine/measure/fields/coarse_graining_observer.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/base/numbers.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

// Makes a name that every program accepts, of ASCII letters, digits and underscores.
std::string plain(const std::string& name) {
    std::string result = name;
    const auto odd = [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'));
    };
    std::replace_if(result.begin(), result.end(), odd, '_');
    return result;
}

std::vector<MeasuredAxis> axes_of(const FieldGrid& grid) {
    const char* const about[] = {"along the depth, from the middle", "across, from the middle",
                                 "height above the floor at rest"};
    const char* const names[] = {"x", "y", "z"};
    std::vector<MeasuredAxis> axes;
    for (const std::size_t k : {2, 1, 0})
        if (grid.axes[k].resolved) axes.push_back({names[k], "m", about[k], grid.axes[k].middles()});
    return axes;
}

}  // namespace

FieldSet coarse_field_set(const Scene& scene, const CoarseGraining& by) {
    FieldSet set;
    set.axes = axes_of(by.grid());
    std::vector<std::string> axes;
    for (const MeasuredAxis& axis : set.axes) axes.push_back(axis.name);
    const auto add = [&](const std::string& name, const std::string& label, const char* unit,
                         const std::string& about) {
        set.fields.push_back({name, label, unit, about, axes});
    };
    add("free_volume", "volume of the cell inside the container", "m3",
        "density times it, summed over all cells, is the mass of the grains");
    add("density", "density", "kg m-3", "mass of grains over volume; kernels clipped at the walls");
    for (std::size_t s = 0; s < scene.species.size(); ++s) {
        std::string name = "solid_fraction_" + plain(scene.species[s].name);
        const auto same = [&](const FieldInfo& field) { return field.name == name; };
        if (std::any_of(set.fields.begin(), set.fields.end(), same)) name += fmt::format("_{}", s + 1);
        add(name, "solid fraction of " + scene.species[s].name, "1",
            "volume of these grains over volume; kernels clipped at the walls");
    }
    for (const char* axis : {"x", "y", "z"})
        add(fmt::format("velocity_{}", axis), fmt::format("velocity along {}", axis), "m s-1",
            "momentum over mass, seen from the container");
    add("granular_temperature", "granular temperature", "m2 s-2",
        "a third of the mean square velocity against the velocity at the same place and phase of the drive");
    for (const char* pair : {"xx", "xy", "xz", "yy", "yz", "zz"})
        add(fmt::format("kinetic_stress_{}", pair), fmt::format("kinetic stress {}", pair), "Pa",
            "symmetric; pressure is positive");
    for (const char* pair : {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"})
        add(fmt::format("contact_stress_{}", pair), fmt::format("contact stress {}", pair), "Pa",
            "force (first index) times branch (second index); pressure is positive");
    return set;
}

FieldValues coarse_field_values(const std::optional<CoarseFields>& fields, const CoarseGraining& by) {
    FieldValues values{by.shares()};
    for (double& share : values[0]) share *= by.grid().cell_volume();
    const std::size_t more = 1 + by.species() + 3 + 1 + 6 + 9;
    if (!fields) {
        values.resize(1 + more, CellValues(by.shares().size(), kUnknown));
        return values;
    }
    const auto add = [&](const auto& several) {
        values.insert(values.end(), several.begin(), several.end());
    };
    values.push_back(fields->density);
    add(fields->solid_fraction);
    add(fields->velocity);
    values.push_back(fields->temperature);
    add(fields->kinetic_stress);
    add(fields->contact_stress);
    return values;
}

namespace {

// All settings on which the sums depend. If one were missing here, a run could go on with sums of other
// fields.
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

FieldMeans::FieldMeans(const Scene& scene, const FieldTimes& times)
    : times_(times), settings_(settings_of(scene, times)), sums_(scene, static_cast<int>(times.phases)) {}

void FieldMeans::start(std::int64_t step, const FieldState& state) {
    sums_.clear();
    open_ = step == 0;
    gather(step, state);
}

void FieldMeans::gather(std::int64_t step, const FieldState& state) {
    ended_ = times_.ends_record(step);
    if (ended_) {
        if (open_ && sums_.moments() > 0) last_ = sums_.mean();
        sums_.clear();
        open_ = true;
    }
    if (open_ && times_.is_moment(step)) sums_.add(state, static_cast<int>(times_.phase_of(step)));
}

void FieldMeans::save(std::ostream& out) const {
    write_vector(out, settings_);
    write_value(out, static_cast<std::int32_t>(open_));
    write_value(out, static_cast<std::int32_t>(ended_ && last_));
    if (ended_ && last_) {
        CoarseFields last = *last_;
        for_each_grid(last, [&](const CellValues& values) { write_vector(out, values); });
    }
    sums_.save(out);
}

void FieldMeans::load(Bytes& in) {
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

void FieldMeans::load_last(Bytes& in) {
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
