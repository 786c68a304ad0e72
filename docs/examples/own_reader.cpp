// A reader of your own, for files that begin with "beads" and have a line "x y z radius" (mm) for each bead.
// Each file is one frame. The program prints what it has read, draws it, and writes it as an XYZ file:
//     own_reader FILE picture.png out.xyz
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

#include <grainreel/error.hpp>
#include <grainreel/picture.hpp>

namespace {

class Beads final : public grainreel::FrameSource {
  public:
    explicit Beads(const std::filesystem::path& path) {
        std::ifstream in(path);
        std::string first;
        std::getline(in, first);
        double x = 0, y = 0, z = 0, radius = 0;
        int line = 2;
        for (; in >> x >> y >> z >> radius; ++line) frame_.add({1e-3 * x, 1e-3 * y, 1e-3 * z}, 1e-3 * radius);
        if (!in.eof() || frame_.size() == 0)
            throw grainreel::Error(path.string() + ":" + std::to_string(line) +
                                   ":1: is no line of four numbers, x y z radius in mm");
    }
    grainreel::World world() const override { return {"beads", {"bead"}, {2500}, {}}; }
    std::vector<double> times() const override { return {std::numeric_limits<double>::quiet_NaN()}; }
    grainreel::Frame frame(std::size_t) const override { return frame_; }
    bool has_velocities() const override { return false; }

  private:
    grainreel::Frame frame_;
};

class BeadsReader final : public grainreel::FrameReader {
  public:
    std::string name() const override { return "beads"; }
    std::string about() const override { return "a list of beads"; }
    bool takes(const grainreel::FileHead& head) const override { return head.bytes.starts_with("beads\n"); }
    std::unique_ptr<grainreel::FrameSource> open(const std::filesystem::path& path) const override {
        return std::make_unique<Beads>(path);
    }
};

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 4) return 2;
    grainreel::add_reader(std::make_shared<BeadsReader>());
    const grainreel::FrameFile file(argv[1]);
    const grainreel::Frame frame = file.frame(0);
    for (std::size_t i = 0; i < frame.size(); ++i)
        std::printf("%d %.12g %.12g\n", frame.id[i], frame.position[i].z, frame.radius[i]);
    grainreel::Painter(file, {"film.size=320x240"}).draw(frame).write_png(argv[2]);
    file.write(argv[3], "xyz");
    return 0;
} catch (const grainreel::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.line() > 0 ? 3 : 1;
}
