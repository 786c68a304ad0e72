#include "render/film/production/side_by_side_drawer.hpp"

namespace grainreel {
namespace {

class SideBySideDrawer final : public Drawer {
  public:
    SideBySideDrawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                     gl::Provider provider, std::size_t clock, std::vector<std::size_t> segments)
        : panels_(panels, film, raster_threads, provider),
          clock_(clock),
          segments_(std::move(segments)),
          rate_(film.rate) {}
    void draw(const Frames& frames, const std::string&, Picture& into) override {
        into = panels_.draw(frames, segments_.at(drawn_), clock_, static_cast<double>(drawn_) / rate_);
        ++drawn_;
    }
    std::string description() const override { return panels_.gl_description(); }
    std::string note() const override { return panels_.gl_note(); }
    std::string last_note() const override { return panels_.last_note(); }

  private:
    SideBySide panels_;
    const std::size_t clock_;
    const std::vector<std::size_t> segments_;
    const double rate_;
    std::size_t drawn_ = 0;
};

}  // namespace

DrawerMaker side_by_side_drawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                                gl::Provider provider, std::size_t clock, std::vector<std::size_t> segments) {
    return [=] {
        return std::make_unique<SideBySideDrawer>(panels, film, raster_threads, provider, clock, segments);
    };
}

}  // namespace grainreel
