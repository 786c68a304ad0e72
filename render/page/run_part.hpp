// The part of a page that shows one run: all texts that report.cpp puts in for it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/page_facts.hpp"
#include "render/page/page_measures.hpp"
#include "render/page/page_parts.hpp"
#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class RunPart {
  public:
    // n: ending of the ids of its elements; "" on a page of one run. most_film: largest number of bytes of
    // its film.
    RunPart(const PageRun& run, std::string name, std::string n, std::size_t most_film);

    // Reads film, measures and words. Throws PageStopped.
    void read(const PageProgress& progress);
    // Bytes of the page that the results of read() take.
    std::size_t taken() const;
    // Reads the grains into at most `most_bytes` packed bytes. Throws PageStopped.
    void read_bed(std::size_t most_bytes, const PageProgress& progress);

    const FilmedScene& scene() const { return run_.scene; }
    const std::filesystem::path& folder() const { return run_.folder; }
    const std::string& name() const { return name_; }
    const PageWords& words() const { return say_; }
    std::string title() const;  // HTML
    Span span() const;          // span of the trajectory and the film

    std::string lead() const { return lead_; }
    bool has_film() const { return !film_.bytes.empty() || !poster_.empty(); }
    std::string film(bool beside) const;  // beside: whether the page lies beside the film's file
    std::string bed() const;
    std::string fields(int level) const;  // level of its heading, 1 to 6; empty when the run kept no fields
    std::string charts_about() const;
    // on_page_of_its_own: whether the page lies in the run's folder, so that it has links to the files there.
    std::string chapters(const std::filesystem::path& page, bool on_page_of_its_own) const;
    std::string facts() const;  // JSON
    // Packed data in elements at the page's end: bed_blob() has the bed with its meshes and forces,
    // late_blobs() the table of measures, the fields and the film.
    std::string bed_blob() const;
    std::string late_blobs() const;
    std::vector<std::string> news() const;  // lines that the user should see

  private:
    void read_table(const std::filesystem::path& file);
    FilmTimes film_times_of();
    const std::filesystem::path& film_folder() const;
    std::optional<std::int64_t> film_frames() const;
    RunOf run_of() const {
        return run_.run && run_.run->kind() == StoredRun::Kind::imported ? RunOf::others : RunOf::us;
    }
    std::vector<std::string> lacking_files() const;
    std::string in_folder(const std::string& line) const;
    std::string no_moments() const;
    Span kept_span() const;  // span of moments and measures

    const PageRun& run_;
    const std::string name_, n_;
    const std::size_t most_film_;
    const PageWords say_;
    ReadRunJson run_json_;
    std::shared_ptr<const MeasureTable> table_;  // null without measures
    PageMeasures measures_;
    PageFilm film_;
    std::vector<std::uint8_t> poster_;
    FilmTimes times_;
    PageBed bed_;
    PageMeshes meshes_;
    std::vector<std::string> bed_news_;
    PageFields fields_;
    std::string lead_, late_blobs_;
    bool whole_table_ = false, table_of_film_is_odd_ = false;
    std::string no_charts_, table_fault_;  // why there are no charts; what is wrong with measures.csv
};

}  // namespace grainreel
