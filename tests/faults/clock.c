/* A clock of the wall that somebody sets back, for one process and those that it starts: LD_PRELOAD names this library,
   FAULT_CLOCK_AFTER says when [s after the start of each process], FAULT_CLOCK_BACK how far [s]. Other clocks go on as
   they do, as when a system's clock is set. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static double now(clockid_t clock)
{
    struct timespec time;
    syscall(SYS_clock_gettime, clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double began;

__attribute__((constructor)) static void begin(void)
{
    began = now(CLOCK_MONOTONIC);
}

static long back(void)
{
    const char *after = getenv("FAULT_CLOCK_AFTER"), *by = getenv("FAULT_CLOCK_BACK");
    if (!after || !by || now(CLOCK_MONOTONIC) - began < atof(after))
        return 0;
    return atol(by);
}

int clock_gettime(clockid_t clock, struct timespec *told)
{
    long failed = syscall(SYS_clock_gettime, clock, told);
    if (!failed && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE))
        told->tv_sec -= back();
    return (int)failed;
}

int gettimeofday(struct timeval *restrict told, void *restrict zone)
{
    struct timespec time;
    (void)zone;
    clock_gettime(CLOCK_REALTIME, &time);
    told->tv_sec = time.tv_sec;
    told->tv_usec = time.tv_nsec / 1000;
    return 0;
}

time_t time(time_t *told)
{
    struct timespec now_;
    clock_gettime(CLOCK_REALTIME, &now_);
    if (told)
        *told = now_.tv_sec;
    return now_.tv_sec;
}
