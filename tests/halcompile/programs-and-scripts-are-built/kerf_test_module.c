#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
MODULE_LICENSE("GPL");

static int id;

int rtapi_app_main(void)
{
    id = hal_init("kerf_test_module");
    return id < 0 ? id : hal_ready(id);
}

void rtapi_app_exit(void)
{
    hal_exit(id);
}
