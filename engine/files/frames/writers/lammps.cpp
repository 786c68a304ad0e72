// Two writers for LAMMPS: a data file of the last frame, and a text dump of all frames.

#include <fmt/format.h>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

// What is added to ids, because LAMMPS counts atoms from 1. It is the same in both formats, so that read_dump
// finds the atoms of read_data.
std::int32_t shift_of_ids(const StoredWorld& world) {
    return world.first_id == 0 ? 1 : 0;
}

// A data file with atom_style sphere (LAMMPS manual, command read_data).
class LammpsData final : public StateWriter {
  public:
    explicit LammpsData(const std::filesystem::path& path) : path_(path) {}

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        world_ = world;
        supply_ = supply;
    }
    void cell(const std::optional<WorldCell>& now) override { world_.cell = now; }
    void frame(const State& frame, const std::vector<Link>&) override { last_ = frame; }
    void end() override {
        if (!last_) throw RunError(path_.string() + ": there is no frame to make a data file of");
        const State& frame = *last_;
        refuse_unknown_motion(path_, frame);
        TextPieces out(path_);
        std::string& text = out.text();
        const WorldCell box = box_of(world_, frame);
        text += fmt::format(
            "LAMMPS data file by grainreel: {} at {} s; units si, atom_style sphere\n\n{} atoms\n{} atom "
            "types\n\n",
            one_word(world_.title), frame.time, frame.size(),
            std::max<std::size_t>(1, world_.species.size()));
        const char* names[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
        for (int axis = 0; axis < 3; ++axis)
            text += fmt::format("{} {} {}\n", box.origin[axis], box.origin[axis] + box.edges[axis][axis],
                                names[axis]);
        const double xy = box.edges[1].x(), xz = box.edges[2].x(), yz = box.edges[2].y();
        if (xy != 0 || xz != 0 || yz != 0) text += fmt::format("{} {} {} xy xz yz\n", xy, xz, yz);
        const std::int32_t shift = shift_of_ids(world_);
        text += "\nAtoms # sphere\n\n";
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3 x = inside(frame.position[i], box);
            text += fmt::format("{} {} {} {} {} {} {}\n", frame.id[i] + shift, frame.species[i] + 1,
                                2 * frame.radius[i], density(frame, i), x.x(), x.y(), x.z());
            out.pass();
        }
        text += "\nVelocities\n\n";
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3 &v = frame.velocity[i], &w = frame.spin[i];
            text += fmt::format("{} {} {} {} {} {} {}\n", frame.id[i] + shift, v.x(), v.y(), v.z(), w.x(),
                                w.y(), w.z());
            out.pass();
        }
        out.flush();
    }
    std::vector<std::string> news() const override { return news_of_rest(path_, supply_); }

  private:
    // The place moved into the box along periodic axes, because read_data refuses atoms outside a box.
    static Vec3 inside(Vec3 place, const WorldCell& box) {
        for (std::size_t edge = 3; edge-- > 0;) {
            const auto axis = static_cast<Eigen::Index>(edge);
            const double length = box.edges[edge][axis];
            if (!box.periodic[edge] || !(length > 0)) continue;
            place -= std::floor((place[axis] - box.origin[axis]) / length) * box.edges[edge];
        }
        return place;
    }
    double density(const State& frame, std::size_t grain) const {
        if (!frame.mass.empty())
            return frame.mass[grain] / (4.0 / 3 * std::numbers::pi * math::cube(frame.radius[grain]));
        const auto s = static_cast<std::size_t>(frame.species[grain]);
        return s < world_.species.size() && world_.species[s].density > 0 ? world_.species[s].density
                                                                          : kGlassDensity;
    }

    std::filesystem::path path_;
    StoredWorld world_;
    StateSupply supply_;
    std::optional<State> last_;
};

// A text dump as LAMMPS writes it (manual, command dump custom). OVITO reads it, and so does `read_dump` of
// LAMMPS and LIGGGHTS.
class LammpsDump final : public StateWriter {
  public:
    explicit LammpsDump(const std::filesystem::path& path) : out_(path) {}

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        world_ = world;
        supply_ = supply;
        out_.text() += "ITEM: UNITS\nsi\n";
    }
    void frame(const State& frame, const std::vector<Link>&) override {
        std::string& text = out_.text();
        const WorldCell box = box_of(world_, frame);
        const std::int32_t shift = shift_of_ids(world_);
        if (world_.time_known) text += fmt::format("ITEM: TIME\n{}\n", frame.time);
        text += fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n", frame.step, frame.size());
        write_box(box, text);
        text += "ITEM: ATOMS id type x y z radius";
        if (supply_.velocities) text += " vx vy vz";
        if (supply_.spins) text += " omegax omegay omegaz";
        if (supply_.masses) text += " mass";
        if (!frame.orientation.empty()) text += " quati quatj quatk quatw";
        text += '\n';
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3 &x = frame.position[i], &v = frame.velocity[i], &w = frame.spin[i];
            text += fmt::format("{} {} {} {} {} {}", frame.id[i] + shift, frame.species[i] + 1, x.x(), x.y(),
                                x.z(), frame.radius[i]);
            if (supply_.velocities) text += fmt::format(" {} {} {}", v.x(), v.y(), v.z());
            if (supply_.spins) text += fmt::format(" {} {} {}", w.x(), w.y(), w.z());
            if (supply_.masses) text += fmt::format(" {}", frame.mass[i]);
            if (!frame.orientation.empty()) {
                const Quaternion& q = frame.orientation[i];
                text += fmt::format(" {} {} {} {}", q.x(), q.y(), q.z(), q.w());
            }
            text += '\n';
            out_.pass();
        }
    }
    void end() override { out_.flush(); }
    std::vector<std::string> news() const override {
        if (world_.steps_known) return {};
        return {"--to lammps-dump: the files say no steps, so TIMESTEP numbers their frames from 0"};
    }
    void cell(const std::optional<WorldCell>& now) override { world_.cell = now; }

  private:
    // A tilted box is written by the bounds of the box around it (manual, Howto_triclinic).
    static void write_box(const WorldCell& box, std::string& text) {
        const double xy = box.edges[1].x(), xz = box.edges[2].x(), yz = box.edges[2].y();
        const auto flag = [&](std::size_t axis) { return box.periodic[axis] ? "pp" : "ff"; };
        const std::string flags = fmt::format("{} {} {}", flag(0), flag(1), flag(2));
        const double lx = box.edges[0].x(), ly = box.edges[1].y(), lz = box.edges[2].z();
        const Vec3& low = box.origin;
        if (xy == 0 && xz == 0 && yz == 0) {
            text += fmt::format("ITEM: BOX BOUNDS {}\n{} {}\n{} {}\n{} {}\n", flags, low.x(), low.x() + lx,
                                low.y(), low.y() + ly, low.z(), low.z() + lz);
            return;
        }
        const double less_x = std::min({0.0, xy, xz, xy + xz}), more_x = std::max({0.0, xy, xz, xy + xz});
        const double less_y = std::min(0.0, yz), more_y = std::max(0.0, yz);
        text += fmt::format("ITEM: BOX BOUNDS xy xz yz {}\n{} {} {}\n{} {} {}\n{} {} {}\n", flags,
                            low.x() + less_x, low.x() + lx + more_x, xy, low.y() + less_y,
                            low.y() + ly + more_y, xz, low.z(), low.z() + lz, yz);
    }

    TextPieces out_;
    StoredWorld world_;
    StateSupply supply_;
};

}  // namespace

WriteFormat lammps_data_format() {
    return {"lammps-data", "data file of LAMMPS (read_data, atom_style sphere), of the last frame", ".data",
            make_writer<LammpsData>};
}

WriteFormat lammps_dump_format() {
    return {"lammps-dump", "text dump of LAMMPS and LIGGGHTS; OVITO opens it", ".dump",
            make_writer<LammpsDump>};
}

}  // namespace grainreel
