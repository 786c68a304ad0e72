// A clock that jumps, to be loaded before the C library (LD_PRELOAD). The time of day goes forth and back by hours at every
// hundredth question. The time since the start, which never goes back on any system, leaps by an hour each time when
// CLOCK_LEAPS is set, as after a virtual machine was halted.
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static long asked;

static int leaps(void) {
    static int known = -1;
    if (known < 0) known = getenv("CLOCK_LEAPS") != NULL;
    return known;
}

int clock_gettime(clockid_t which, struct timespec* now) {
    static const long hours[] = {0, 5, -3, 100, -100, 1, -24};
    const int failed = (int)syscall(SYS_clock_gettime, which, now);
    const long count = __atomic_add_fetch(&asked, 1, __ATOMIC_RELAXED) / 100;
    if (which == CLOCK_REALTIME || which == CLOCK_REALTIME_COARSE) now->tv_sec += 3600 * hours[count % 7];
    if (which == CLOCK_MONOTONIC && leaps()) now->tv_sec += 3600 * count;
    return failed;
}

time_t time(time_t* out) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (out != NULL) *out = now.tv_sec;
    return now.tv_sec;
}

int gettimeofday(struct timeval* restrict out, void* restrict zone) {
    struct timespec now;
    (void)zone;
    clock_gettime(CLOCK_REALTIME, &now);
    out->tv_sec = now.tv_sec;
    out->tv_usec = now.tv_nsec / 1000;
    return 0;
}
