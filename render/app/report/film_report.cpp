#include "render/app/report/film_report.hpp"

#include <cstdio>

#include "engine/base/text.hpp"
#include "render/app/report/result.hpp"

namespace grainreel {

int tell_folder(const FolderRun::Ended& ended, const FilmRequest& request) {
    if (ended.folder && request.to_stdout)
        std::fprintf(stderr, "%s\n", visible(ended.folder->string()).c_str());
    if (ended.folder && !request.to_stdout) print_exact(ended.folder->string() + "\n");
    return ended.exit_status;
}

}  // namespace grainreel
