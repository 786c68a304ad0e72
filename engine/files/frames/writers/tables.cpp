// Writers of text with one row a grain: CSV, the program's own table of grains, and extended XYZ.

#include <fmt/format.h>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/grain_table.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

// One long table with a row for each grain of each frame, for spreadsheets, pandas and R.
class Csv final : public StateWriter {
  public:
    explicit Csv(const std::filesystem::path& path) : out_(path) {}

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        world_ = world;
        supply_ = supply;
        if (world.time_known) out_.text() += "time,";
        if (world.steps_known) out_.text() += "step,";
        if (!world.time_known && !world.steps_known) out_.text() += "frame,";
        out_.text() += "id,type,species,x,y,z,radius";
        if (supply.velocities) out_.text() += ",vx,vy,vz";
        if (supply.spins) out_.text() += ",wx,wy,wz";
        if (supply.masses) out_.text() += ",mass";
        if (supply.contact_numbers) out_.text() += ",contact_number";
        out_.text() += '\n';
    }
    void frame(const State& frame, const std::vector<Link>&) override {
        for (std::size_t i = 0; i < frame.size(); ++i) {
            std::string& text = out_.text();
            const Vec3 &x = frame.position[i], &v = frame.velocity[i], &w = frame.spin[i];
            const auto s = static_cast<std::size_t>(frame.species[i]);
            if (world_.time_known) text += fmt::format("{},", frame.time);
            if (world_.steps_known || !world_.time_known) text += fmt::format("{},", frame.step);
            text += fmt::format("{},{},{},{},{},{},{}", frame.id[i], s + 1,
                                s < world_.species.size() ? one_word(world_.species[s].name) : "", x.x(),
                                x.y(), x.z(), frame.radius[i]);
            if (supply_.velocities) text += fmt::format(",{},{},{}", v.x(), v.y(), v.z());
            if (supply_.spins) text += fmt::format(",{},{},{}", w.x(), w.y(), w.z());
            if (supply_.masses) text += fmt::format(",{}", frame.mass[i]);
            if (supply_.contact_numbers)
                text += fmt::format(",{}", i < frame.contact_number.size() ? frame.contact_number[i] : 0);
            text += '\n';
            out_.pass();
        }
    }
    void end() override { out_.flush(); }

  private:
    TextPieces out_;
    StoredWorld world_;
    StateSupply supply_;
};

// A table of grains as in final.csv, of the last frame.
class GrainTable final : public StateWriter {
  public:
    explicit GrainTable(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const StoredWorld&, const StateSupply& supply) override { supply_ = supply; }
    void frame(const State& frame, const std::vector<Link>&) override { last_ = frame; }
    void end() override {
        if (!last_) throw RunError(path_.string() + ": there is no frame to make a table of");
        refuse_unknown_motion(path_, *last_);
        write_grain_table(path_, *last_);
    }
    std::vector<std::string> news() const override { return news_of_rest(path_, supply_); }

  private:
    std::filesystem::path path_;
    StateSupply supply_;
    std::optional<State> last_;
};

// Extended XYZ by the rules of ASE and OVITO. Columns are element, pos, radius, velo, omega and id; Lattice
// and pbc give the box. Names of species stand in `element`, because ASE takes a column `species` for symbols
// of the periodic table and stops at "Small".
class Xyz final : public StateWriter {
  public:
    explicit Xyz(const std::filesystem::path& path) : out_(path) {}

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        world_ = world;
        supply_ = supply;
    }
    void cell(const std::optional<WorldCell>& now) override { world_.cell = now; }
    void frame(const State& frame, const std::vector<Link>&) override {
        std::string& text = out_.text();
        const WorldCell box = box_of(world_, frame);
        const auto edge = [](const Vec3& e) { return fmt::format("{} {} {}", e.x(), e.y(), e.z()); };
        const auto flag = [&](std::size_t axis) { return box.periodic[axis] ? 'T' : 'F'; };
        text += fmt::format(
            "{}\nLattice=\"{} {} {}\" Origin=\"{}\" pbc=\"{} {} {}\" "
            "Properties=element:S:1:pos:R:3:radius:R:1{}{}{}:id:I:1{}{}\n",
            frame.size(), edge(box.edges[0]), edge(box.edges[1]), edge(box.edges[2]), edge(box.origin),
            flag(0), flag(1), flag(2), supply_.velocities ? ":velo:R:3" : "",
            supply_.spins ? ":omega:R:3" : "", supply_.masses ? ":mass:R:1" : "",
            world_.steps_known ? fmt::format(" Step={}", frame.step) : "",
            world_.time_known ? fmt::format(" Time={}", frame.time) : "");
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3 &x = frame.position[i], &v = frame.velocity[i], &w = frame.spin[i];
            text +=
                fmt::format("{} {} {} {} {}", name(frame.species[i]), x.x(), x.y(), x.z(), frame.radius[i]);
            if (supply_.velocities) text += fmt::format(" {} {} {}", v.x(), v.y(), v.z());
            if (supply_.spins) text += fmt::format(" {} {} {}", w.x(), w.y(), w.z());
            if (supply_.masses) text += fmt::format(" {}", frame.mass[i]);
            text += fmt::format(" {}\n", frame.id[i]);
            out_.pass();
        }
    }
    void end() override { out_.flush(); }

  private:
    std::string name(std::int32_t species) const {
        const auto s = static_cast<std::size_t>(species);
        return s < world_.species.size() ? one_word(world_.species[s].name)
                                         : fmt::format("type_{}", species + 1);
    }

    TextPieces out_;
    StoredWorld world_;
    StateSupply supply_;
};

}  // namespace

WriteFormat csv_format() {
    return {"csv", "one table of all frames, SI units: for spreadsheets, pandas and R", ".csv",
            make_writer<Csv>};
}

WriteFormat grain_table_format() {
    return {"grain-table", "a table of grains (final.csv), of the last frame", ".csv",
            make_writer<GrainTable>};
}

WriteFormat xyz_writer_format() {
    return {"xyz", "extended XYZ, as ASE and OVITO read it", ".xyz", make_writer<Xyz>};
}

}  // namespace grainreel
