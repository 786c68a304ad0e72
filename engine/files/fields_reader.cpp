#include "engine/files/fields_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/checksum.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"

namespace grainreel {

namespace {

const std::array<std::string, 3> axis_names{"x", "y", "z"};

struct FieldVariable {
    int id;
    std::vector<std::size_t> shape;  // without the record
    bool in_space;                   // all its axes are places
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
        throw UserError(fmt::format("{}: {}; copy the file again", source, what));
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

    // A field of the places alone, with all of the grid's axes in the file's order, or one that only the
    // checksum needs.
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
        variables;  // those with records, in the file's order: time and its bounds first
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
    // A grid of one cell along an axis: as wide as along another.
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
