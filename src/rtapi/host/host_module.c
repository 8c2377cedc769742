/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_module.c - realtime modules: load, parameters, unload, instances.
 *
 * In:     module name and PARAMETER=VALUE words; <rtlib>/<name>.so
 * Out:    rtapi_app_main called; symbols visible to later modules
 * Thread: the command thread [init]
 */
#include "host.h"

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "kerf_paths.h"

struct text { /* a string parameter: the module's as long as its code is there */
    struct text *next;
    char value[];
};
struct module {
    struct module *older;
    void *handle;
    void (*exit)(void);
    struct text *texts;
    char name[];
};
static struct module *newest;

static void say(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
static void say(const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    rtapi_get_msg_handler()(RTAPI_MSG_ERR, fmt, ap);
    va_end(ap);
}

static struct module *find(const char *name)
{
    struct module *m = newest;
    while (m && strcmp(m->name, name) != 0) {
        m = m->older;
    }
    return m;
}

/* ---- Parameters --------------------------------------------------------- */

static void *info(void *handle, const char *kind, const char *parameter)
{
    char symbol[256];
    int n = snprintf(symbol, sizeof symbol, "rtapi_info_%s_%s", kind, parameter);
    return n > 0 && (size_t)n < sizeof symbol ? dlsym(handle, symbol) : NULL;
}

/* Stores one value at element i. word: the whole "name=value", for messages. */
static int store(struct module *m, const char *word, char type, void *address, int i, const char *value)
{
    char *end;
    errno = 0;
    switch (type) {
    case 'i':
    case 'l': {
        long n = strtol(value, &end, 0);
        if (*end) {
            say("`%s' invalid for parameter `%s'\n", value, word);
            return -1;
        }
        if (errno == ERANGE || (type == 'i' && (n < INT_MIN || n > INT_MAX))) {
            say("`%s' invalid for parameter `%s'\n", value, word);
            return -1;
        }
        if (type == 'i') {
            ((int *)address)[i] = (int)n;
        } else {
            ((long *)address)[i] = n;
        }
        return 0;
    }
    case 's': {
        struct text *text = malloc(sizeof *text + strlen(value) + 1);
        if (!text) {
            return -1;
        }
        strcpy(text->value, value);
        text->next = m->texts;
        m->texts = text;
        ((char **)address)[i] = text->value;
        return 0;
    }
    default:
        say("%.*s: Invalid type character `%c'\n", (int)strcspn(word, "="), word, type);
        return -1;
    }
}

static int store_array(struct module *m, const char *word, char type, void *address, int size,
                       char *values)
{
    char *value = values;
    for (int i = 0; value; i++) {
        char *comma = strchr(value, ',');
        if (comma) {
            *comma = 0;
        }
        if (i >= size) {
            say("%s: can only take %d arguments\n", word, size);
            return -1;
        }
        if (store(m, word, type, address, i, value) < 0) {
            return -1;
        }
        value = comma ? comma + 1 : NULL;
    }
    return 0;
}

/* word is changed. 0 or -1. */
static int set_parameter(struct module *m, char *word)
{
    char *to = word;
    for (const char *from = word; *from; from++) {
        if (*from != '"') {
            *to++ = *from;
        }
    }
    *to = 0;
    char *equals = strchr(word, '=');
    if (!equals) {
        say("Invalid parameter `%s'\n", word);
        return -1;
    }
    char *values = strdup(equals + 1);
    char *name = strndup(word, (size_t)(equals - word));
    int result = -1;
    if (values && name) {
        void *address_info = info(m->handle, "address", name);
        void *type_info = info(m->handle, "type", name);
        void *size_info = info(m->handle, "size", name);
        if (!address_info) {
            say("Unknown parameter `%s'\n", word);
        } else if (!type_info) {
            say("Unknown parameter `%s' (type information missing)\n", word);
        } else {
            char type = **(const char **)type_info;
            void *address = *(void **)address_info;
            result = size_info ? store_array(m, word, type, address, *(int *)size_info, values)
                               : store(m, word, type, address, 0, values);
        }
    }
    free(values);
    free(name);
    return result;
}

/* ---- Load and unload ---------------------------------------------------- */

static void module_path(char *path, size_t size, const char *name)
{
    snprintf(path, size, "%s/%s.so", kerf_path(KERF_PATH_RTLIB), name);
}

static void free_texts(struct module *m)
{
    while (m->texts) {
        struct text *text = m->texts;
        m->texts = text->next;
        free(text);
    }
}

/* Gives module and parameters back. Code that others still use stays, and its strings with it. */
static void drop(struct module *m)
{
    char path[PATH_MAX];
    module_path(path, sizeof path, m->name);
    if (m->handle) {
        dlclose(m->handle);
    }
    void *stays = m->texts ? dlopen(path, RTLD_LAZY | RTLD_NOLOAD) : NULL;
    if (stays) {
        dlclose(stays);
    } else {
        free_texts(m);
    }
    free(m);
}

static int start_module(struct module *m, int argc, char **argv)
{
    int (*start)(void) = (int (*)(void))dlsym(m->handle, "rtapi_app_main");
    if (!start) {
        say("%s: dlsym: %s\n", m->name, dlerror());
        return -1;
    }
    m->exit = (void (*)(void))dlsym(m->handle, "rtapi_app_exit");
    if (!m->exit) {
        say("%s: component is missing rtapi_app_exit\n", m->name);
        return -1;
    }
    for (int i = 0; i < argc; i++) {
        if (set_parameter(m, argv[i]) < 0) {
            return -1;
        }
    }
    int result = start();
    if (result < 0) {
        say("%s: rtapi_app_main: %s (%d)\n", m->name, strerror(-result), result);
    }
    return result;
}

int host_load(int argc, char **argv)
{
    const char *name = argv[0];
    char path[PATH_MAX];
    if (strchr(name, '/') || strstr(name, "..")) {
        say("%s: Not allowed as module name. Slashes or with \"..\" (even /a..b/) are not allowed.\n", name);
        return -1;
    }
    if (find(name)) {
        say("%s: already exists\n", name);
        return -1;
    }
    struct module *m = calloc(1, sizeof *m + strlen(name) + 1);
    if (!m) {
        say("%s: out of memory\n", name);
        return -1;
    }
    strcpy(m->name, name);
    module_path(path, sizeof path, name);
    m->handle = dlopen(path, RTLD_GLOBAL | RTLD_NOW);
    if (!m->handle) {
        say("%s: dlopen: %s\n", name, dlerror());
        if (access(path, F_OK) != 0) {
            say("%s: this system has no such module: correct the name, load another driver, or "
                "build it (halcompile --install)\n",
                name);
        }
        drop(m);
        return -1;
    }
    int result = start_module(m, argc - 1, argv + 1);
    if (result < 0) {
        drop(m);
        return result;
    }
    m->older = newest;
    newest = m;
    return 0;
}

static void end_module(struct module *m)
{
    struct module **link = &newest;
    while (*link != m) {
        link = &(*link)->older;
    }
    m->exit();
    Dl_info where; /* code must not go while a task runs it */
    if (dladdr((const void *)(uintptr_t)m->exit, &where)) {
        host_tasks_end_of(where.dli_fbase, m->name);
    }
    *link = m->older;
    drop(m);
}

int host_unload(const char *name)
{
    struct module *m = find(name);
    if (!m) {
        say("%s: not loaded\n", name);
        return -1;
    }
    end_module(m);
    return 0;
}

void host_unload_all(void)
{
    while (newest) {
        end_module(newest);
    }
}

int host_newinst(const char *comp, const char *inst, const char *arg)
{
    int (*make)(const char *, const char *, const char *) = NULL;
    struct module *hal = find("hal_lib");
    if (hal) {
        make = (int (*)(const char *, const char *, const char *))dlsym(hal->handle, "hal_comp_invoke_make");
    }
    int result = make ? make(comp, inst, arg) : -EFAULT;
    if (result == -ENOENT || result == -EFAULT) {
        say("newinst: component %s not found\n", comp);
    } else if (result == -ENOEXEC) {
        say("newinst: component %s does not support instantiation\n", comp);
    } else if (result != 0) {
        say("newinst: component %s returned error %d\n", comp, result);
    }
    return result == 0 ? 0 : -1;
}

/* ---- Small services for modules ----------------------------------------- */

long int simple_strtol(const char *nptr, char **endptr, int base)
{
    return strtol(nptr, endptr, base);
}

char **rtapi_argv_split(unsigned long gfp, const char *text, int *argc)
{
    (void)gfp;
    size_t words = 0, len = strlen(text);
    for (size_t i = 0; i < len; i++) {
        words += !isspace((unsigned char)text[i]) && (i == 0 || isspace((unsigned char)text[i - 1]));
    }
    char **argv = malloc((words + 1) * sizeof *argv + len + 1); /* pointers, then the text */
    if (!argv) {
        return NULL;
    }
    char *copy = (char *)(argv + words + 1), *rest;
    strcpy(copy, text);
    size_t n = 0;
    for (char *w = strtok_r(copy, " \t\n\v\f\r", &rest); w && n < words; w = strtok_r(NULL, " \t\n\v\f\r", &rest)) {
        argv[n++] = w;
    }
    argv[n] = NULL;
    if (argc) {
        *argc = (int)n;
    }
    return argv;
}

void rtapi_argv_free(char **argv)
{
    free(argv);
}

char *rtapi_kstrndup(const char *s, size_t max, unsigned long gfp)
{
    (void)gfp;
    return strndup(s, max);
}
