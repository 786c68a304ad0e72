// Extended XYZ, by the rules of ASE and OVITO: columns element, pos, radius, velo, omega, id; Lattice and pbc
// where there is a periodic box. Names of species stand in `element`: ASE takes those in `species` for
// symbols of the periodic table, and ends at "Small".
#include <fmt/format.h>

#include "engine/files/frames/frame_writer.hpp"

namespace grainreel {

namespace {

class Xyz final : public FrameWriter {
  public:
    explicit Xyz(const std::filesystem::path& path) : out_(path) {}

    void begin(const World& world, const FrameSupply& supply) override {
        world_ = world;
        supply_ = supply;
    }
    void frame(const Frame& frame) override {
        std::string& text = out_.text();
        const WorldCell box = box_of(world_, frame);
        const auto edge = [](const Vec3& e) { return fmt::format("{} {} {}", e.x(), e.y(), e.z()); };
        const auto flag = [&](std::size_t axis) { return box.periodic[axis] ? 'T' : 'F'; };
        text += fmt::format(
            "{}\nLattice=\"{} {} {}\" Origin=\"{}\" pbc=\"{} {} {}\" "
            "Properties=element:S:1:pos:R:3:radius:R:1{}:id:I:1 Step={}{}\n",
            frame.size(), edge(box.edges[0]), edge(box.edges[1]), edge(box.edges[2]), edge(box.origin),
            flag(0), flag(1), flag(2), supply_.velocities ? ":velo:R:3:omega:R:3" : "", frame.step,
            world_.time_known ? fmt::format(" Time={}", frame.time) : "");
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3 &x = frame.position[i], &v = frame.velocity[i], &w = frame.spin[i];
            text +=
                fmt::format("{} {} {} {} {}", name(frame.species[i]), x.x(), x.y(), x.z(), frame.radius[i]);
            if (supply_.velocities)
                text += fmt::format(" {} {} {} {} {} {}", v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
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
    World world_;
    FrameSupply supply_;
};

std::unique_ptr<FrameWriter> make(const std::filesystem::path& path) {
    return std::make_unique<Xyz>(path);
}

}  // namespace

FrameFormat xyz_writer_format() {
    return {"xyz", "extended XYZ, as ASE and OVITO read it", ".xyz", make};
}

}  // namespace grainreel
