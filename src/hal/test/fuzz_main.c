/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fuzz_main.c - runs the files of a corpus through a fuzz target, without libFuzzer.
 */
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const unsigned char *data, unsigned long size);

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        FILE *file = fopen(argv[i], "rb");
        if (!file) {
            perror(argv[i]);
            return 1;
        }
        static unsigned char data[1 << 20];
        unsigned long size = fread(data, 1, sizeof data, file);
        fclose(file);
        unsigned char *exact = malloc(size ? size : 1); /* so that sanitizers see its end */
        for (unsigned long k = 0; exact && k < size; k++) {
            exact[k] = data[k];
        }
        LLVMFuzzerTestOneInput(exact, size);
        free(exact);
    }
    printf("%d files: no promise broken\n", argc - 1);
    return 0;
}
