#include "engine/files/fields_file.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/error.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"

namespace grainreel {

namespace {

// The largest number of cells that still fits into one variable of CDF-2.
constexpr std::size_t most_cells_of_cdf2 = ((std::size_t{1} << 32) - 4) / sizeof(double);

std::size_t cells_of(const FieldSet& set, const FieldInfo& field) {
    std::size_t cells = 1;
    for (const std::string& name : field.axes)
        for (const MeasuredAxis& axis : set.axes)
            if (axis.name == name) cells *= axis.at.size();
    return cells;
}

NetcdfFormat format_for(const std::vector<const FieldSet*>& sets) {
    for (const FieldSet* const set : sets)
        for (const FieldInfo& field : set->fields)
            if (cells_of(*set, field) > most_cells_of_cdf2) return NetcdfFormat::cdf5;
    return NetcdfFormat::cdf2;
}

struct Variable {
    int id;
    std::vector<std::size_t> shape;  // without the dimension of records
};

}  // namespace

struct FieldsWriter::Impl {
    explicit Impl(NetcdfFile to) : file(std::move(to)) {}

    void find_fields(const FieldSet& set);
    void define_times();
    void define_checksum();
    void define_axes(const FieldSet& set);
    void define_fields(const FieldSet& set);

    struct Axis {
        int dimension, variable;
        MeasuredAxis axis;
    };
    NetcdfFile file;
    std::map<std::string, Axis> axes;          // by their names in the file
    std::map<std::string, std::string> named;  // names in the file of the axes of the current set
    std::set<std::string> names;               // names of the fields in the file
    int record = -1, time = -1, bounds = -1;
    std::array<int, 2> checksum{-1, -1};
    std::vector<std::vector<Variable>> fields;  // one for each set
    std::size_t records = 0;
};

void FieldsWriter::Impl::define_times() {
    record = file.dimension("time", NC_UNLIMITED);
    const int two = file.dimension("two", 2);
    time = file.variable("time", NC_DOUBLE, {record}, "s");
    file.attribute(time, "long_name", "time since the drive started");
    file.attribute(time, "comment", "the middle of the record; every field is a mean over the record");
    file.attribute(time, "axis", "T");
    file.attribute(time, "bounds", "time_bounds");
    bounds = file.variable("time_bounds", NC_DOUBLE, {record, two}, "s");
    file.attribute(bounds, "long_name", "where the record begins and ends");
}

// The checksum is two variables of one number each, because VTK's reader would show a variable of two numbers
// as a grid.
void FieldsWriter::Impl::define_checksum() {
    for (const std::size_t word : {0, 1}) {
        checksum[word] = file.variable(word == 0 ? "checksum_high" : "checksum_low", NC_INT, {record}, "1");
        file.attribute(checksum[word], "long_name",
                       "half of the XXH64 of the record's numbers, chained in the order of the file");
    }
}

void FieldsWriter::Impl::define_axes(const FieldSet& set) {
    named.clear();
    for (const MeasuredAxis& axis : set.axes) {
        std::string name = axis.name;
        const auto differs = [&](const Axis& other) {
            return other.axis.at != axis.at || other.axis.unit != axis.unit;
        };
        for (int k = 2; axes.count(name) > 0 && differs(axes.at(name)); ++k)
            name = fmt::format("{}_{}", axis.name, k);
        named[axis.name] = name;
        if (axes.count(name) > 0) continue;
        const int dimension = file.dimension(name, axis.at.size());
        const int variable = file.variable(name, NC_DOUBLE, {dimension}, axis.unit);
        file.attribute(variable, "long_name", axis.about);
        // x and y get no axis attribute, because ParaView would take them for longitude and latitude.
        if (axis.name == "z") {
            file.attribute(variable, "axis", "Z");
            file.attribute(variable, "positive", "up");
        }
        axes[name] = {dimension, variable, axis};
    }
}

void FieldsWriter::Impl::define_fields(const FieldSet& set) {
    fields.emplace_back();
    for (const FieldInfo& field : set.fields) {
        std::vector<int> dimensions{record};
        Variable variable{-1, {}};
        for (const std::string& axis : field.axes) {
            const Axis& entry = axes.at(named.at(axis));
            dimensions.push_back(entry.dimension);
            variable.shape.push_back(entry.axis.at.size());
        }
        GRAINREEL_CHECK(names.insert(field.name).second && axes.count(field.name) == 0);
        variable.id = file.variable(field.name, NC_DOUBLE, dimensions, field.unit);
        file.attribute(variable.id, "long_name", field.label);
        file.attribute(variable.id, "comment", field.about);
        fields.back().push_back(variable);
    }
}

// Finds the variables in an existing file.
void FieldsWriter::Impl::find_fields(const FieldSet& set) {
    fields.emplace_back();
    for (const FieldInfo& field : set.fields) {
        Variable variable{file.find_variable(field.name), {}};
        for (const std::string& name : field.axes)
            for (const MeasuredAxis& axis : set.axes)
                if (axis.name == name) variable.shape.push_back(axis.at.size());
        fields.back().push_back(variable);
    }
}

FieldsWriter::FieldsWriter(const std::filesystem::path& path, const std::vector<const FieldSet*>& sets,
                           const std::string& title, const std::string& program_version,
                           const FileFacts& facts)
    : impl_(std::make_unique<Impl>(NetcdfFile::create(path, format_for(sets)))) {
    NetcdfFile& file = impl_->file;
    file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
    file.attribute(NC_GLOBAL, "title", title);
    file.attribute(NC_GLOBAL, "source", "grainreel " + program_version);
    file.attribute(NC_GLOBAL, "program", "grainreel");
    file.attribute(NC_GLOBAL, "programVersion", program_version);
    for (const auto& [attribute, text] : facts.attributes) file.attribute(NC_GLOBAL, attribute, text);
    impl_->define_times();
    for (const FieldSet* const set : sets) {
        impl_->define_axes(*set);
        impl_->define_fields(*set);
    }
    impl_->define_checksum();
    file.end_definitions();
    for (const auto& [name, axis] : impl_->axes)
        file.put(axis.variable, {0}, {axis.axis.at.size()}, axis.axis.at.data());
    file.sync(0);
}

std::size_t FieldsWriter::records_before(const std::filesystem::path& path, double time) {
    const NetcdfFile file = NetcdfFile::open(path);
    const std::size_t counted = file.length("time");
    const std::size_t records = std::min(counted, file.records_on_disk(counted));
    std::vector<double> bounds(2 * records);
    if (records > 0) file.get(file.find_variable("time_bounds"), {0, 0}, {records, 2}, bounds.data());
    std::size_t before = 0;
    while (before < records && bounds[2 * before + 1] < time) ++before;
    return before;
}

KeptRecords FieldsWriter::kept_before(const std::filesystem::path& path,
                                      const std::vector<const FieldSet*>& sets, double time) {
    const NetcdfFile file = NetcdfFile::open(path);
    for (const FieldSet* const set : sets)
        for (const FieldInfo& field : set->fields) file.find_variable(field.name);
    for (const char* sum : {"checksum_high", "checksum_low"}) file.find_variable(sum);
    return NetcdfFile::kept_of(path, records_before(path, time));
}

FieldsWriter::FieldsWriter(const std::filesystem::path& path, const std::vector<const FieldSet*>& sets,
                           double time) {
    const std::size_t records = records_before(path, time);
    impl_ = std::make_unique<Impl>(NetcdfFile::append(path, records));
    impl_->records = records;
    impl_->time = impl_->file.find_variable("time");
    impl_->bounds = impl_->file.find_variable("time_bounds");
    impl_->checksum = {impl_->file.find_variable("checksum_high"), impl_->file.find_variable("checksum_low")};
    for (const FieldSet* const set : sets) impl_->find_fields(*set);
}

FieldsWriter::~FieldsWriter() = default;

void FieldsWriter::write(double begin, double end, const std::vector<FieldValues>& values) {
    Impl& to = *impl_;
    const std::size_t record = to.records;
    Checksum sum;
    const auto put = [&](int variable, std::vector<std::size_t> shape, const double* numbers) {
        std::vector<std::size_t> start(shape.size() + 1, 0);
        std::size_t count = 1;
        for (const std::size_t length : shape) count *= length;
        start[0] = record;
        shape.insert(shape.begin(), 1);
        to.file.put(variable, start, shape, numbers);
        sum.add(numbers, count);
    };
    const double middle = 0.5 * (begin + end), span[2] = {begin, end};
    put(to.time, {}, &middle);
    put(to.bounds, {2}, span);
    GRAINREEL_CHECK(values.size() == to.fields.size());
    for (std::size_t set = 0; set < values.size(); ++set) {
        GRAINREEL_CHECK(values[set].size() == to.fields[set].size());
        for (std::size_t f = 0; f < values[set].size(); ++f) {
            const Variable& variable = to.fields[set][f];
            std::size_t cells = 1;
            for (const std::size_t length : variable.shape) cells *= length;
            GRAINREEL_CHECK(values[set][f].size() == cells);
            put(variable.id, variable.shape, values[set][f].data());
        }
    }
    for (const std::size_t word : {0, 1}) to.file.put(to.checksum[word], {record}, {1}, &sum.words()[word]);
    to.file.sync(record + 1);
    ++to.records;  // only now, because a record that failed does not count
}

std::int64_t FieldsWriter::records() const {
    return static_cast<std::int64_t>(impl_->records);
}

namespace {

const std::array<std::string, 3> axis_names{"x", "y", "z"};

struct FieldVariable {
    int id;
    std::vector<std::size_t> shape;  // without the dimension of records
    bool in_space;                   // whether all its axes are places
};

}  // namespace

struct FieldsReader::Impl {
    explicit Impl(const std::filesystem::path& path) : source(path.string()), file(NetcdfFile::open(path)) {
        for (const std::string& axis : axis_names)
            if (file.has_variable(axis)) read_middles(axis);
        const std::size_t counted = file.length("time");
        records = std::min(counted, file.records_on_disk(counted));
        for (const std::string& name : file.variables()) find(name);
    }

    [[noreturn]] void damaged(const std::string& what) const {
        throw UserError("{}: {}; copy the file again", source, what);
    }

    void read_middles(const std::string& name) {
        const auto axis = static_cast<std::size_t>(name[0] - 'x');
        std::vector<double>& at = middles[axis];
        at.resize(file.length(name));
        if (!at.empty()) file.get(file.find_variable(name), {0}, {at.size()}, at.data());
        const double cell = at.size() > 1 ? (at.back() - at.front()) / static_cast<double>(at.size() - 1) : 0;
        for (std::size_t k = 0; k < at.size(); ++k)
            if (!(std::abs(at[k] - at.front() - static_cast<double>(k) * cell) <= 1e-6 * std::abs(cell)))
                damaged(fmt::format("the cells along {} are not evenly spaced", name));
    }

    // Takes a variable that has records. It is a field to be read if its axes are those of the grid, in the
    // same order. Any other variable is needed only for the checksum.
    void find(const std::string& name) {
        const int id = file.find_variable(name);
        const std::vector<std::string> axes = file.dimensions_of(id);
        if (axes.empty() || axes.front() != "time") return;
        if (name == "checksum_high" || name == "checksum_low") return;
        std::vector<std::string> grid;
        for (const std::size_t axis : {2, 1, 0})
            if (!middles[axis].empty()) grid.push_back(axis_names[axis]);
        FieldVariable variable{id, {}, std::vector<std::string>(axes.begin() + 1, axes.end()) == grid};
        for (std::size_t k = 1; k < axes.size(); ++k) variable.shape.push_back(file.length(axes[k]));
        if (variable.in_space && !grid.empty()) names.push_back(name);
        variable.in_space = variable.in_space && !grid.empty();
        variables.push_back(std::move(variable));
    }

    std::vector<double> values(const FieldVariable& variable, std::size_t record) const {
        std::vector<std::size_t> start(variable.shape.size() + 1, 0), count{1};
        start[0] = record;
        count.insert(count.end(), variable.shape.begin(), variable.shape.end());
        std::size_t cells = 1;
        for (const std::size_t length : variable.shape) cells *= length;
        std::vector<double> numbers(cells);
        if (cells > 0) file.get(variable.id, start, count, numbers.data());
        return numbers;
    }

    std::string source;  // for messages
    NetcdfFile file;
    Middles middles;
    std::vector<std::string> names;
    std::vector<FieldVariable>
        variables;  // those with records, in the order of the file; time and its bounds come first
    std::size_t records = 0;
};

FieldsReader::FieldsReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
FieldsReader::~FieldsReader() = default;

const FieldsReader::Middles& FieldsReader::middles() const {
    return impl_->middles;
}

std::array<double, 3> FieldsReader::cell() const {
    std::array<double, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& at = impl_->middles[axis];
        if (at.size() > 1) cell[axis] = at[1] - at[0];
    }
    // If a grid has one cell along an axis, that cell is as wide as along another axis.
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (impl_->middles[axis].size() == 1) cell[axis] = *std::max_element(cell.begin(), cell.end());
    return cell;
}

const std::vector<std::string>& FieldsReader::names() const {
    return impl_->names;
}

std::size_t FieldsReader::records() const {
    return impl_->records;
}

std::array<double, 2> FieldsReader::span(std::size_t record) const {
    std::array<double, 2> ends{};
    impl_->file.get(impl_->file.find_variable("time_bounds"), {record, 0}, {1, 2}, ends.data());
    return ends;
}

std::vector<std::vector<double>> FieldsReader::read(std::size_t record) const {
    Checksum sum;
    std::vector<std::vector<double>> all;
    for (const FieldVariable& variable : impl_->variables) {
        std::vector<double> numbers = impl_->values(variable, record);
        sum.add(numbers.data(), numbers.size());
        if (variable.in_space) all.push_back(std::move(numbers));
    }
    std::array<int, 2> kept{};
    impl_->file.get(impl_->file.find_variable("checksum_high"), {record}, {1}, &kept[0]);
    impl_->file.get(impl_->file.find_variable("checksum_low"), {record}, {1}, &kept[1]);
    if (kept != sum.words())
        impl_->damaged(fmt::format(
            "record {} (the first is 0) is damaged: its checksum is not that of its numbers", record));
    return all;
}

}  // namespace grainreel
