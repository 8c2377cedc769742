/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fuzz_host.c - any bytes given to what the realtime host reads of others: nothing may crash.
 *
 * The first byte chooses: p a module parameter, r a request on its socket. The host's two files
 * are taken in as they are. `make fuzz` makes a libFuzzer program of it (clang);
 * objects/test/host-fuzz FILE... runs the files of a corpus (tests/fuzz/host).
 */
#define main rtapi_app_main_program
#include "../../rtapi/host/host_main.c"
#undef main

#define say module_say
#define find module_find
#include "../../rtapi/host/host_module.c"

/* A module's parameters, as the macros of rtapi.h would export them. */
static int number, numbers[4];
static long large;
static char *text, *texts[3];
#define PARAMETER(name, kind, where)                                                    \
    __attribute__((visibility("default"))) void *rtapi_info_address_##name = where;     \
    __attribute__((visibility("default"))) const char *rtapi_info_type_##name = kind
PARAMETER(number, "i", &number);
PARAMETER(large, "l", &large);
PARAMETER(text, "s", &text);
PARAMETER(numbers, "i", numbers);
PARAMETER(texts, "s", texts);
PARAMETER(odd, "q", &number);
__attribute__((visibility("default"))) int rtapi_info_size_numbers = 4;
__attribute__((visibility("default"))) int rtapi_info_size_texts = 3;

static void parameter(char *word)
{
    static struct module self;
    if (!self.handle) {
        self.handle = dlopen(NULL, RTLD_NOW);
    }
    set_parameter(&self, word);
    free_texts(&self);
}

static void request(const unsigned char *data, unsigned long size)
{
    int argc = 0;
    char **argv = NULL;
    if (size < 2 || size > MESSAGE_MAX - 2) {
        return;
    }
    if (parse_request(data, size, &argc, &argv)) {
        unsigned long letters = 0;
        for (int i = 0; i < argc; i++) {
            letters += strlen(argv[i]);
        }
        if ((argc > 0 && argv[argc]) || letters > size) {
            abort();
        }
    }
    if (argv) {
        free(argv[0]);
        free(argv);
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *data, unsigned long size);
int LLVMFuzzerTestOneInput(const unsigned char *data, unsigned long size)
{
    if (size < 1 || size > 8192) {
        return 0;
    }
    if (data[0] == 'r') {
        request(data + 1, size - 1);
    } else if (data[0] == 'p') {
        char *word = strndup((const char *)data + 1, size - 1);
        if (word) {
            parameter(word);
        }
        free(word);
    }
    return 0;
}
