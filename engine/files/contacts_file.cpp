#include "engine/files/contacts_file.hpp"

#include <netcdf.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"

namespace grainreel {

namespace {

// A row of the file.
struct Row {
    std::int32_t frame, first, second;
    float normal;
    std::array<float, 3> tangential, point;
    std::int32_t triangle = -1;             // only in files of scenes with meshes
    std::array<float, 3> rolling{0, 0, 0};  // only in files of scenes whose contacts resist rolling
};
static_assert(sizeof(Row) == 14 * sizeof(float));  // no gaps in a row

// The checksum is over the bytes of all numbers that the file has.
int checksum_of(const Row& row, bool meshes, bool rolls) {
    std::array<char, sizeof(Row)> bytes;
    constexpr std::size_t kAlways = offsetof(Row, triangle);
    std::memcpy(bytes.data(), &row, kAlways);
    std::size_t size = kAlways;
    const auto append = [&](const auto& numbers) {
        std::memcpy(bytes.data() + size, &numbers, sizeof numbers);
        size += sizeof numbers;
    };
    if (meshes) append(row.triangle);
    if (rolls) append(row.rolling);
    return static_cast<int>(XXH32(bytes.data(), size, 0));
}

constexpr std::int32_t most_faces = 1000;  // no scene has so many faces and meshes

// Whether a run can have written such a row, whatever its checksum says.
bool possible(const Row& row) {
    return row.frame >= 0 && row.first >= 0 && row.second >= -most_faces && std::isfinite(row.normal) &&
           row.normal >= 0 && row.triangle >= -1;
}

std::array<float, 3> floats(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

struct ContactsWriter::Impl {
    explicit Impl(NetcdfFile to) : file(std::move(to)) {}

    // Writes a column. of(row) gives the Width numbers of a row.
    template <class Value, std::size_t Width, class Of>
    void put_column(int variable, const std::vector<Row>& of_rows, const Of& of) {
        std::vector<Value> column;
        for (const Row& row : of_rows) {
            const std::array<Value, Width> numbers = of(row);
            column.insert(column.end(), numbers.begin(), numbers.end());
        }
        std::vector<std::size_t> start{rows}, count{of_rows.size()};
        if (Width > 1) start.push_back(0), count.push_back(Width);
        file.put(variable, start, count, column.data());
    }

    NetcdfFile file;
    std::size_t rows = 0;
    bool meshes = false, rolls = false;
    int frame = -1, first = -1, second = -1, normal = -1, tangential = -1, point = -1, triangle = -1,
        rolling = -1, checksum = -1;
};

ContactsWriter::ContactsWriter(const std::filesystem::path& path, const std::string& title,
                               const std::string& program_version, const FileFacts& facts, bool meshes,
                               bool rolls)
    : impl_(std::make_unique<Impl>(NetcdfFile::create(path, NetcdfFormat::cdf2))) {
    impl_->meshes = meshes;
    impl_->rolls = rolls;
    NetcdfFile& file = impl_->file;
    file.attribute(NC_GLOBAL, "title", title);
    file.attribute(NC_GLOBAL, "program", "grainreel");
    file.attribute(NC_GLOBAL, "programVersion", program_version);
    for (const auto& [attribute, text] : facts.attributes) file.attribute(NC_GLOBAL, attribute, text);
    const int row = file.dimension("row", NC_UNLIMITED);
    const int spatial = file.dimension("spatial", 3);
    const auto define = [&](const char* name, int type, const char* units, const char* about,
                            const std::string& comment, bool vector = false) {
        const int variable =
            file.variable(name, type, vector ? std::vector{row, spatial} : std::vector{row}, units);
        file.attribute(variable, "long_name", about);
        if (!comment.empty()) file.attribute(variable, "comment", comment);
        return variable;
    };
    impl_->frame = define("frame", NC_INT, "1", "frame of the trajectory in which they touch",
                          "from 0, of trajectory.nc; in key_contacts.nc of key_moments.nc");
    impl_->first = define("first", NC_INT, "1", "number of the grain that pushes", "the grain's `id`");
    impl_->second = define("second", NC_INT, "1", "number of the grain or wall that is pushed",
                           "the grain's `id`, or below 0 a wall: -1 - its place among the faces" +
                               (facts.walls.empty() ? "" : "; " + facts.walls));
    impl_->normal = define("normal", NC_FLOAT, "N", "normal force", "0 or more: it pushes apart");
    impl_->tangential =
        define("tangential", NC_FLOAT, "N", "tangential force on the second one", "x, y, z", true);
    impl_->point = define("point", NC_FLOAT, "m", "point of contact", "x, y, z in the room", true);
    if (meshes)
        impl_->triangle = define("triangle", NC_INT, "1", "triangle of the mesh that is pushed",
                                 "from 0, as in trajectory.nc; -1 of what is no mesh");
    if (rolls)
        impl_->rolling =
            define("rolling", NC_FLOAT, "N m", "torque of the resistance to rolling on the second one",
                   "x, y, z; the first one gets the opposite", true);
    impl_->checksum = define("checksum", NC_INT, "1", "XXH32 of the row's other numbers", "for grainreel");
    file.end_definitions();
    file.sync(0);
}

ContactsWriter::ContactsWriter(const std::filesystem::path& path, std::size_t frames) {
    const std::size_t rows = ContactsReader(path).rows_of_first(frames);
    impl_ = std::make_unique<Impl>(NetcdfFile::append(path, rows));
    impl_->rows = rows;
    const std::array<std::pair<int*, const char*>, 7> variables{{{&impl_->frame, "frame"},
                                                                 {&impl_->first, "first"},
                                                                 {&impl_->second, "second"},
                                                                 {&impl_->normal, "normal"},
                                                                 {&impl_->tangential, "tangential"},
                                                                 {&impl_->point, "point"},
                                                                 {&impl_->checksum, "checksum"}}};
    for (const auto& [variable, name] : variables) *variable = impl_->file.find_variable(name);
    impl_->meshes = impl_->file.has_variable("triangle");
    if (impl_->meshes) impl_->triangle = impl_->file.find_variable("triangle");
    impl_->rolls = impl_->file.has_variable("rolling");
    if (impl_->rolls) impl_->rolling = impl_->file.find_variable("rolling");
}

ContactsWriter::~ContactsWriter() = default;

KeptRecords ContactsWriter::kept_of(const std::filesystem::path& path, std::size_t frames) {
    const ContactsReader reader(path);
    if (frames > 0 && !reader.has_all(frames - 1))
        throw UserError("{}: was cut off; it lacks contacts of the first {} frames", path.string(), frames);
    const NetcdfFile file = NetcdfFile::open(path);
    for (const char* name : {"frame", "first", "second", "normal", "tangential", "point", "checksum"})
        file.find_variable(name);
    return NetcdfFile::kept_of(path, reader.rows_of_first(frames));
}

void ContactsWriter::write(std::int64_t frame, const std::vector<SavedContact>& contacts) {
    if (contacts.empty()) return;
    std::vector<Row> rows;
    for (const SavedContact& c : contacts)
        rows.push_back({static_cast<std::int32_t>(frame), c.first, c.second, static_cast<float>(c.normal),
                        floats(c.tangential), floats(c.point), c.triangle, floats(c.rolling)});
    using Int = std::array<int, 1>;
    Impl& to = *impl_;
    to.put_column<int, 1>(to.frame, rows, [](const Row& r) { return Int{r.frame}; });
    to.put_column<int, 1>(to.first, rows, [](const Row& r) { return Int{r.first}; });
    to.put_column<int, 1>(to.second, rows, [](const Row& r) { return Int{r.second}; });
    to.put_column<float, 1>(to.normal, rows, [](const Row& r) { return std::array<float, 1>{r.normal}; });
    to.put_column<float, 3>(to.tangential, rows, [](const Row& r) { return r.tangential; });
    to.put_column<float, 3>(to.point, rows, [](const Row& r) { return r.point; });
    if (to.meshes) to.put_column<int, 1>(to.triangle, rows, [](const Row& r) { return Int{r.triangle}; });
    if (to.rolls) to.put_column<float, 3>(to.rolling, rows, [](const Row& r) { return r.rolling; });
    to.put_column<int, 1>(to.checksum, rows,
                          [&](const Row& r) { return Int{checksum_of(r, to.meshes, to.rolls)}; });
    to.rows += rows.size();
    to.file.sync(to.rows);
}

struct ContactsReader::Impl {
    explicit Impl(const std::filesystem::path& path) : source(path.string()), file(NetcdfFile::open(path)) {
        checksums = file.has_variable("checksum");
        meshes = file.has_variable("triangle");
        rolls = file.has_variable("rolling");
        const std::size_t counted = file.length("row"), on_disk = file.records_on_disk(counted);
        const std::size_t rows = std::min(counted, on_disk);
        cut_off = rows < counted;
        uncounted = on_disk - rows;
        frame_of.resize(rows);
        if (rows > 0) file.get(file.find_variable("frame"), {0}, {rows}, frame_of.data());
        const auto fall = std::is_sorted_until(frame_of.begin(), frame_of.end());
        if (fall != frame_of.end())
            damaged(static_cast<std::size_t>(fall - frame_of.begin()),
                    "its frame is less than the one before");
    }

    [[noreturn]] void damaged(std::size_t row, const char* what) const {
        throw UserError(
            "{}: row {} (the first is 0) is damaged: {}; copy the file again, or let "
            "film.colour.by be something else and film.force_chains false",
            source, row, what);
    }

    // Reads a column of `count` rows. set(row, numbers) gets the Width numbers of each.
    template <class Value, std::size_t Width, class Set>
    void get_column(const char* name, std::size_t begin, std::vector<Row>& rows, const Set& set) const {
        std::vector<std::size_t> start{begin}, count{rows.size()};
        if (Width > 1) start.push_back(0), count.push_back(Width);
        std::vector<std::array<Value, Width>> column(rows.size());
        file.get(file.find_variable(name), start, count, column.front().data());
        for (std::size_t i = 0; i < rows.size(); ++i) set(rows[i], column[i]);
    }

    std::vector<Row> read(std::size_t begin, std::size_t count) const {
        std::vector<Row> rows(count);
        get_column<int, 1>("frame", begin, rows, [](Row& r, const auto& v) { r.frame = v[0]; });
        get_column<int, 1>("first", begin, rows, [](Row& r, const auto& v) { r.first = v[0]; });
        get_column<int, 1>("second", begin, rows, [](Row& r, const auto& v) { r.second = v[0]; });
        get_column<float, 1>("normal", begin, rows, [](Row& r, const auto& v) { r.normal = v[0]; });
        get_column<float, 3>("tangential", begin, rows, [](Row& r, const auto& v) { r.tangential = v; });
        get_column<float, 3>("point", begin, rows, [](Row& r, const auto& v) { r.point = v; });
        if (meshes)
            get_column<int, 1>("triangle", begin, rows, [](Row& r, const auto& v) { r.triangle = v[0]; });
        if (rolls) get_column<float, 3>("rolling", begin, rows, [](Row& r, const auto& v) { r.rolling = v; });
        std::vector<int> sums(count);
        if (checksums) file.get(file.find_variable("checksum"), {begin}, {count}, sums.data());
        for (std::size_t i = 0; i < count; ++i) {
            if (checksums && sums[i] != checksum_of(rows[i], meshes, rolls))
                damaged(begin + i, "its checksum is not that of its numbers");
            if (!possible(rows[i])) damaged(begin + i, "it holds what no contact can have");
        }
        return rows;
    }

    // The contacts of a frame of the trajectory, in the order of the file.
    std::vector<Row> rows_of(std::size_t frame) const;

    std::string source;  // for messages
    NetcdfFile file;
    bool checksums = false, meshes = false, rolls = false;
    std::vector<int> frame_of;  // number of the frame of each row, rising
    bool cut_off = false;
    std::size_t uncounted = 0;
};

ContactsReader::ContactsReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
ContactsReader::~ContactsReader() = default;

std::size_t ContactsReader::rows_of_first(std::size_t frames) const {
    const std::vector<int>& all = impl_->frame_of;
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), static_cast<int>(frames)) -
                                    all.begin());
}

bool ContactsReader::has_all(std::size_t frame) const {
    const std::vector<int>& frames = impl_->frame_of;
    return !impl_->cut_off || (!frames.empty() && static_cast<int>(frame) < frames.back());
}

bool ContactsReader::cut_off() const {
    return impl_->cut_off;
}

std::size_t ContactsReader::uncounted() const {
    return impl_->uncounted;
}

bool ContactsReader::has_checksums() const {
    return impl_->checksums;
}

std::vector<Row> ContactsReader::Impl::rows_of(std::size_t frame) const {
    const std::vector<int>& frames = frame_of;
    const auto [low, high] = std::equal_range(frames.begin(), frames.end(), static_cast<int>(frame));
    // One more row is read and checked on each side: it may be a row of this frame with a damaged number.
    const auto from = low - (low == frames.begin() ? 0 : 1), to = high + (high == frames.end() ? 0 : 1);
    if (from == to) return {};
    std::vector<Row> rows =
        read(static_cast<std::size_t>(from - frames.begin()), static_cast<std::size_t>(to - from));
    std::erase_if(rows, [&](const Row& row) { return row.frame != static_cast<int>(frame); });
    return rows;
}

std::vector<Link> ContactsReader::touches(std::size_t frame) const {
    std::vector<Link> touches;
    if (!has_all(frame)) return touches;
    for (const Row& row : impl_->rows_of(frame)) touches.push_back({row.first, row.second, row.normal});
    return touches;
}

std::vector<SavedContact> ContactsReader::contacts(std::size_t frame) const {
    std::vector<SavedContact> contacts;
    if (!has_all(frame)) return contacts;
    const auto vector = [](const std::array<float, 3>& v) { return Vec3(v[0], v[1], v[2]); };
    for (const Row& row : impl_->rows_of(frame))
        contacts.push_back({row.first, row.second, row.normal, vector(row.tangential), vector(row.point),
                            row.triangle, vector(row.rolling)});
    return contacts;
}

}  // namespace grainreel
