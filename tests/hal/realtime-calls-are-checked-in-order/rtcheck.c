/* Calls of the HAL interface from a realtime module; prints what comes of them. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_string.h>
#include <hal.h>

MODULE_LICENSE("GPL");

static int id;
static char l41[] = "a23456789b123456789c123456789d123456789e1";
static char l40[] = "a23456789b123456789c123456789d123456789e";
static char l45[] = "t23456789b123456789c123456789d123456789e12345";
static char l56[] = "a23456789b123456789c123456789d123456789e123456789f12345x";

static const char *word(int r)
{
    return r == -EINVAL   ? "-EINVAL"
           : r == -EPERM  ? "-EPERM"
           : r == -ENOENT ? "-ENOENT"
           : r == -EEXIST ? "-EEXIST"
           : r == -ENOMEM ? "-ENOMEM"
           : r == -EALREADY ? "-EALREADY"
           : r == -ENOEXEC  ? "-ENOEXEC"
           : r > 0        ? "> 0"
           : r == 0       ? "0"
                          : "other";
}
#define SHOW(call)                              \
    do {                                        \
        int show_r = (call);                    \
        rtapi_print("%s: %s\n", #call, word(show_r)); \
    } while (0)

static void to_out(msg_level_t level, const char *fmt, va_list ap)
{
    char text[400];
    (void)level;
    rtapi_vsnprintf(text, sizeof text, fmt, ap);
    rtapi_set_msg_handler(NULL);
    rtapi_print("  | %s", text);
    rtapi_set_msg_handler(to_out);
}

static void f(void *arg, long period)
{
    (void)arg;
    (void)period;
}

static int make(const char *prefix, const char *arg)
{
    rtapi_print("make %s %s\n", prefix, arg);
    return 5;
}

static void functions(void)
{
    SHOW(hal_export_funct(l56, f, 0, 0, 0, id));
    SHOW(hal_export_functf(f, 0, 0, 0, id, "%s", l56));
    SHOW(hal_export_funct("f", f, 0, 0, 0, 9999));
    SHOW(hal_export_funct(l41, f, 0, 0, 0, id));
    SHOW(hal_export_funct(l40, f, 0, 0, 0, id));
    SHOW(hal_export_funct("f", f, 0, 0, 0, id));
    SHOW(hal_export_funct("f", f, 0, 0, 0, id));
    SHOW(hal_export_funct("g", f, 0, 0, 1, id));
    SHOW(hal_export_funct("h", f, 0, 0, 0, id));
    SHOW(hal_export_funct("i", f, 0, 0, 0, id));
}

static void threads(void)
{
    SHOW(hal_create_thread("t", 0, 1));
    SHOW(hal_create_thread(l56, 1000000, 1));
    SHOW(hal_create_thread(l45, 1000000, 1));
    SHOW(hal_create_thread("fast", 1000000, 1));
    SHOW(hal_create_thread("fast", 2000000, 1));
    SHOW(hal_create_thread("faster", 999999, 1));
    SHOW(hal_create_thread("slow", 2600000, 1));
    SHOW(hal_create_thread("between", 2000000, 1));
    SHOW(hal_create_thread("same", 3499999, 1));
    SHOW(hal_create_thread("slowest", 3500000, 1));
    SHOW(hal_init("__slow"));
}

static void lists(void)
{
    SHOW(hal_add_funct_to_thread("f", "fast", 2));
    SHOW(hal_add_funct_to_thread("f", "fast", -2));
    SHOW(hal_add_funct_to_thread("f", "fast", 1));
    SHOW(hal_add_funct_to_thread("f", "slow", 1));
    SHOW(hal_add_funct_to_thread("g", "fast", -1));
    SHOW(hal_add_funct_to_thread("g", "fast", 1));
    SHOW(hal_add_funct_to_thread("g", "slow", 1));
    SHOW(hal_add_funct_to_thread("h", "fast", -2));
    SHOW(hal_add_funct_to_thread("i", "fast", -6));
    SHOW(hal_add_funct_to_thread("i", "fast", 6));
    SHOW(hal_add_funct_to_thread("i", "nothread", 0));
    SHOW(hal_add_funct_to_thread("i", "nothread", 1));
    SHOW(hal_add_funct_to_thread("i", "fast", -5));
    SHOW(hal_init_funct_to_thread("f", "fast", 1));
    SHOW(hal_init_funct_to_thread("f", "fast", 1));
    SHOW(hal_init_funct_to_thread("f", "fast", 4));
    SHOW(hal_init_funct_to_thread("none", "fast", 1));
    SHOW(hal_init_funct_to_thread("h", "none", 1));
    SHOW(hal_del_funct_from_thread("none", "fast"));
    SHOW(hal_del_funct_from_thread(l40, "fast"));
    SHOW(hal_del_funct_from_thread("h", "none"));
    SHOW(hal_del_funct_from_thread("h", "slow"));
    SHOW(hal_del_funct_from_thread("h", "fast"));
    SHOW(hal_del_funct_from_thread("g", "fast"));
}

int rtapi_app_main(void)
{
    rtapi_set_msg_handler(to_out);
    id = hal_init("rtcheck");
    SHOW(id);
    SHOW(hal_init("rtcheck"));
    SHOW(hal_malloc(8) == NULL);
    functions();
    SHOW(hal_comp_invoke_make("rtcheck", "a", "b"));
    SHOW(hal_set_constructor(9999, make));
    SHOW(hal_set_constructor(id, make));
    SHOW(hal_comp_invoke_make("none", "a", "b"));
    SHOW(hal_comp_invoke_make("rtcheck", NULL, "b"));
    SHOW(hal_comp_invoke_make("rtcheck", "a", "b"));
    hal_ready(id);
    SHOW(hal_export_funct("late", f, 0, 0, 0, id));
    threads();
    lists();
    rtapi_set_msg_handler(NULL);
    return 0;
}

void rtapi_app_exit(void)
{
    rtapi_set_msg_handler(to_out);
    SHOW(hal_init_funct_to_thread("f", "fast", 1));
    SHOW(hal_thread_delete("none"));
    SHOW(hal_thread_delete("fast"));
    SHOW(hal_thread_delete("slow"));
    SHOW(hal_exit(id));
    SHOW(hal_exit(id));
    rtapi_set_msg_handler(NULL);
}
