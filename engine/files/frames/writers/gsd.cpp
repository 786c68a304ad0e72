// Writes GSD files: file layer 2.0, schema hoomd 1.4 (gsd.readthedocs.io, "File layer" and "HOOMD Schema").
// Numbers are floats and the box is centred at 0. GSD knows grains by their rows, so their ids are written to
// log/particles/id.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/base/error.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

enum Type : std::uint8_t { kUint8 = 1, kUint32 = 3, kUint64 = 4, kInt8 = 5, kFloat = 9, kDouble = 10 };

// An entry of the index with the fields, and in the order, of the file format.
struct Entry {
    std::uint64_t frame, rows;
    std::int64_t location;
    std::uint32_t columns;
    std::uint16_t name;
    std::uint8_t type, flags;
};
static_assert(sizeof(Entry) == 32);

template <class T>
void append(std::string& to, const T& value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    to.append(raw, sizeof(T));
}

class Gsd final : public StateWriter {
  public:
    explicit Gsd(const std::filesystem::path& path)
        : path_(path), out_(path, std::ios::binary | std::ios::trunc) {
        put(std::string(256, '\0'));
    }

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        world_ = world;
        supply_ = supply;
    }

    void cell(const std::optional<WorldCell>& now) override { world_.cell = now; }

    void frame(const State& frame, const std::vector<Link>&) override {
        const std::size_t n = frame.size();
        const WorldCell box = box_of(world_, frame);
        Vec3 shift(0, 0, 0);
        float lengths[6] = {};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double low = box.origin[axis], length = box.edges[a][axis];
            if (box.periodic[a]) {
                shift[axis] = low + 0.5 * length;
                lengths[a] = static_cast<float>(length);
            } else {
                lengths[a] = static_cast<float>(2 * std::max(std::abs(low), std::abs(low + length)));
            }
        }
        const double ly = box.edges[1].y(), lz = box.edges[2].z();
        lengths[3] = ly != 0 ? static_cast<float>(box.edges[1].x() / ly) : 0;
        lengths[4] = lz != 0 ? static_cast<float>(box.edges[2].x() / lz) : 0;
        lengths[5] = lz != 0 ? static_cast<float>(box.edges[2].y() / lz) : 0;

        if (world_.steps_known)
            chunk<std::uint64_t>("configuration/step", kUint64, 1,
                                 {static_cast<std::uint64_t>(std::max<std::int64_t>(0, frame.step))});
        chunk<float>("configuration/box", kFloat, 1, std::vector<float>(lengths, lengths + 6));
        chunk<std::uint32_t>("particles/N", kUint32, 1, {static_cast<std::uint32_t>(n)});
        write_types();
        std::vector<std::uint32_t> type(n), id(n);
        std::vector<float> place, velocity, diameter, mass, turned;
        for (std::size_t i = 0; i < n; ++i) {
            type[i] = static_cast<std::uint32_t>(frame.species[i]);
            id[i] = static_cast<std::uint32_t>(frame.id[i]);
            for (int axis = 0; axis < 3; ++axis) {
                place.push_back(static_cast<float>(frame.position[i][axis] - shift[axis]));
                velocity.push_back(static_cast<float>(frame.velocity[i][axis]));
            }
            diameter.push_back(static_cast<float>(2 * frame.radius[i]));
            mass.push_back(static_cast<float>(mass_of(frame, i, density_of(type[i]))));
            if (frame.orientation.empty()) continue;
            const Quaternion& q = frame.orientation[i];
            for (const double part : {q.w(), q.x(), q.y(), q.z()}) turned.push_back(static_cast<float>(part));
        }
        chunk("particles/typeid", kUint32, n, type);
        chunk("particles/position", kFloat, n, place);
        if (supply_.velocities) chunk("particles/velocity", kFloat, n, velocity);
        chunk("particles/diameter", kFloat, n, diameter);
        chunk("particles/mass", kFloat, n, mass);
        if (!frame.orientation.empty()) chunk("particles/orientation", kFloat, n, turned);
        chunk("log/particles/id", kUint32, n, id);
        if (world_.time_known) chunk<double>("log/time", kDouble, 1, {frame.time});
        ++frames_;
    }

    void end() override {
        // Readers find an entry of a frame by bisection on the numbers of names, so entries are sorted.
        std::stable_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
            return a.frame != b.frame ? a.frame < b.frame : a.name < b.name;
        });
        const std::uint64_t index = place_, room = entries_.size() + 1;
        std::string bytes;
        for (const Entry& entry : entries_) append(bytes, entry);
        bytes.append(sizeof(Entry), '\0');
        put(bytes);
        std::string names;
        for (const std::string& name : names_) names += name + '\0';
        const std::uint64_t list = place_, parts = names.size() / 64 + 1;
        names.resize(parts * 64, '\0');
        put(names);
        // The head of the file in the order of the format: magic, index, names, versions of schema and file
        // layer.
        std::string head;
        for (const std::uint64_t one : {std::uint64_t{0x65DF65DF65DF65DF}, index, room, list, parts})
            append(head, one);
        append(head, std::uint32_t{1 << 16 | 4});
        append(head, std::uint32_t{2 << 16});
        for (const char* text : {"grainreel", "hoomd"}) {
            std::string field = text;
            field.resize(64, '\0');
            head += field;
        }
        head.resize(256, '\0');
        out_.seekp(0);
        out_.write(head.data(), static_cast<std::streamsize>(head.size()));
        out_.close();
        check();
    }

  private:
    double density_of(std::uint32_t species) const {
        return species < world_.species.size() && world_.species[species].density > 0
                   ? world_.species[species].density
                   : kGlassDensity;
    }
    void check() const {
        if (!out_) throw RunError("{}: cannot be written; is the disk full?", path_.string());
    }
    void put(const std::string& bytes) {
        out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        place_ += bytes.size();
        check();
    }
    // Adds a table of rows x columns numbers under a name.
    template <class T>
    void chunk(const std::string& name, Type type, std::size_t rows, const std::vector<T>& values) {
        if (values.empty()) return;
        auto found = std::find(names_.begin(), names_.end(), name);
        if (found == names_.end()) found = names_.insert(names_.end(), name);
        const bool box = name == "configuration/box";
        entries_.push_back({frames_, box ? values.size() : rows, static_cast<std::int64_t>(place_),
                            static_cast<std::uint32_t>(box ? 1 : values.size() / rows),
                            static_cast<std::uint16_t>(found - names_.begin()), type, 0});
        std::string bytes(values.size() * sizeof(T), '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        put(bytes);
    }
    void write_types() {
        if (frames_ > 0) return;
        std::size_t longest = 1;
        for (const WorldSpecies& one : world_.species) longest = std::max(longest, one.name.size() + 1);
        std::vector<std::int8_t> text;
        for (const WorldSpecies& one : world_.species) {
            std::string field = one.name;
            field.resize(longest, '\0');
            text.insert(text.end(), field.begin(), field.end());
        }
        chunk("particles/types", kInt8, std::max<std::size_t>(1, world_.species.size()), text);
    }

    std::filesystem::path path_;
    std::ofstream out_;
    StoredWorld world_;
    StateSupply supply_;
    std::vector<Entry> entries_;
    std::vector<std::string> names_;
    std::uint64_t place_ = 0, frames_ = 0;
};

}  // namespace

WriteFormat gsd_writer_format() {
    return {"gsd", "GSD with schema hoomd, floats", ".gsd", make_writer<Gsd>};
}

}  // namespace grainreel
