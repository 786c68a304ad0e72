#include "render/app/report/record.hpp"

#include "build_info.hpp"
#include "render/app/report/version.hpp"

namespace grainreel {

ProgramInfo program_info() {
    return {build_info::version, build_info::commit, build_info::compiler, build_info::flags,
            library_versions()};
}

}  // namespace grainreel
