#include "engine/output/contacts_file.hpp"

#include <netcdf.h>

#include <algorithm>

#include "engine/output/netcdf_file.hpp"

namespace grainreel {

struct ContactsWriter::Impl {
    explicit Impl(const std::filesystem::path& path) : file(NetcdfFile::create(path, NetcdfFormat::cdf2)) {}

    template <class Value, class Of>
    void put_column(int variable, std::size_t width, std::size_t count, const Of& of) {
        std::vector<Value> column(count * width);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < width; ++k)
                column[i * width + k] = static_cast<Value>(of(i, static_cast<int>(k)));
        }
        file.put(variable, {rows, 0}, {count, width}, column.data());
    }

    NetcdfFile file;
    std::size_t rows = 0;
    int frame = -1, first = -1, second = -1, normal = -1, tangential = -1, point = -1;
};

ContactsWriter::ContactsWriter(const std::filesystem::path& path, const std::string& title,
                               const std::string& program_version)
    : impl_(std::make_unique<Impl>(path)) {
    NetcdfFile& file = impl_->file;
    file.attribute(NC_GLOBAL, "title", title);
    file.attribute(NC_GLOBAL, "program", "grainreel");
    file.attribute(NC_GLOBAL, "programVersion", program_version);
    const int row = file.dimension("row", NC_UNLIMITED);
    const int spatial = file.dimension("spatial", 3);
    impl_->frame = file.variable("frame", NC_INT, {row});
    impl_->first = file.variable("first", NC_INT, {row});
    impl_->second = file.variable("second", NC_INT, {row});
    impl_->normal = file.variable("normal", NC_FLOAT, {row}, "newton");
    impl_->tangential = file.variable("tangential", NC_FLOAT, {row, spatial}, "newton");
    impl_->point = file.variable("point", NC_FLOAT, {row, spatial}, "meter");
    file.end_definitions();
    file.sync(0);
}

ContactsWriter::~ContactsWriter() = default;

void ContactsWriter::write(std::int64_t frame, const std::vector<Simulation::ContactRecord>& c) {
    const std::size_t n = c.size();
    if (n == 0) return;
    impl_->put_column<int>(impl_->frame, 1, n, [&](std::size_t, int) { return frame; });
    impl_->put_column<int>(impl_->first, 1, n, [&](std::size_t i, int) { return c[i].first; });
    impl_->put_column<int>(impl_->second, 1, n, [&](std::size_t i, int) { return c[i].second; });
    impl_->put_column<float>(impl_->normal, 1, n, [&](std::size_t i, int) { return c[i].normal; });
    impl_->put_column<float>(impl_->tangential, 3, n,
                             [&](std::size_t i, int k) { return c[i].tangential[k]; });
    impl_->put_column<float>(impl_->point, 3, n, [&](std::size_t i, int k) { return c[i].point[k]; });
    impl_->rows += n;
    impl_->file.sync(impl_->rows);
}

struct ContactsReader::Impl {
    explicit Impl(const std::filesystem::path& path) : file(NetcdfFile::open(path)) {
        first = file.find_variable("first");
        second = file.find_variable("second");
        normal = file.find_variable("normal");
        const std::size_t written = file.length("row"), rows = file.whole_records(written);
        cut_off = rows < written;
        frame_of.resize(rows);
        if (rows > 0) file.get(file.find_variable("frame"), {0}, {rows}, frame_of.data());
    }

    NetcdfFile file;
    int first = -1, second = -1, normal = -1;
    std::vector<int> frame_of;  // of each row, rising
    bool cut_off = false;
};

ContactsReader::ContactsReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
ContactsReader::~ContactsReader() = default;

bool ContactsReader::cut_off() const {
    return impl_->cut_off;
}

std::vector<Touch> ContactsReader::touches(std::size_t frame) const {
    const std::vector<int>& frames = impl_->frame_of;
    const auto [low, high] = std::equal_range(frames.begin(), frames.end(), static_cast<int>(frame));
    const auto begin = static_cast<std::size_t>(low - frames.begin()),
               count = static_cast<std::size_t>(high - low);
    if (count == 0) return {};
    std::vector<int> first(count), second(count);
    std::vector<double> normal(count);
    impl_->file.get(impl_->first, {begin}, {count}, first.data());
    impl_->file.get(impl_->second, {begin}, {count}, second.data());
    impl_->file.get(impl_->normal, {begin}, {count}, normal.data());
    std::vector<Touch> touches(count);
    for (std::size_t i = 0; i < count; ++i) touches[i] = {first[i], second[i], normal[i]};
    return touches;
}

}  // namespace grainreel
