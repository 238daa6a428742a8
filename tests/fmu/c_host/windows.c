/* The start of a program on Windows, which stands directly on the system's own C library; main is called host_main. */
#include <stdlib.h>

int host_main(int argc, char **argv);
int __cdecl _configure_narrow_argv(int mode);

void mainCRTStartup(void) {
    _configure_narrow_argv(1);
    exit(host_main(*__p___argc(), *__p___argv()));
}
