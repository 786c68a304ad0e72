// A disk of a few hundred kilobytes, for tests that fill it.
#pragma once

#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace grainreel::test {

class SmallDisk {
  public:
    // Lays the disk over an existing folder. This process and those that it starts see it.
    SmallDisk(const std::filesystem::path& folder, std::size_t bytes) : folder_(folder) {
        mounted_ =
            has_own_mounts() && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
            ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, ("size=" + std::to_string(bytes)).c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool mounted() const { return mounted_; }  // false where mounting is not allowed

  private:
    // Gives this process mounts of its own. Who is not root gets them in a user namespace, with the same user
    // and group there (user_namespaces(7)), where the machine lets users have one.
    static bool has_own_mounts() {
        if (::unshare(CLONE_NEWNS) == 0) return true;
        const std::string user = std::to_string(::getuid()), group = std::to_string(::getgid());
        if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
        std::ofstream("/proc/self/setgroups") << "deny";
        std::ofstream("/proc/self/uid_map") << user << " " << user << " 1";
        std::ofstream("/proc/self/gid_map") << group << " " << group << " 1";
        return true;
    }

    std::filesystem::path folder_;
    bool mounted_ = false;
};

}  // namespace grainreel::test
