// What fills a folder with a film of frames that it does not run itself.
#pragma once

#include "engine/run/folder/folder_run.hpp"
#include "render/film/run/folder_film.hpp"

namespace grainreel {

class FilmRun : public FolderRun {
  protected:
    FilmRun(const FilmRequest& request, RunListener& listener)
        : FolderRun(request, listener), film_(request, desk_) {}

    SideWork* side_work() override { return &film_; }

    FolderFilm film_;
};

}  // namespace grainreel
