#include "render/cli/report/record.hpp"

#include "build_info.hpp"
#include "render/cli/report/version.hpp"

namespace grainreel {

void describe_program(RunRecord& record, const std::string& command) {
    record.command = command;
    record.version = build_info::version;
    record.commit = build_info::commit;
    record.compiler = build_info::compiler;
    record.build_flags = build_info::flags;
    record.libraries = library_versions();
    record.started = utc_now();
}

}  // namespace grainreel
