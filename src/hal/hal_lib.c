/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_lib.c - the HAL library as the first module of the realtime host.
 *
 * Thread: [init]
 */
#include "hal_priv.h"

#include <string.h>
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Hardware abstraction layer");
MODULE_LICENSE("GPL");

int rtapi_app_main(void)
{
    int id = rtapi_init("HAL_LIB");
    if (id < 0) {
        halp_err("HAL_LIB: ERROR: rtapi init failed\n");
        return -EINVAL;
    }
    int result = halp_map(id);
    if (result < 0) {
        rtapi_exit(id);
        return result;
    }
    halp_lib_module_id = id;
    halp_lock();
    halp_reap(NULL);
    halp_process_self(&hal_data->host);
    hal_data->realtime_type = rtapi_get_realtime_type();
    hal_data->base_period = 0;
    halp_unlock();
    return 0;
}

void rtapi_app_exit(void)
{
    halp_threads_end();
    halp_lock();
    halp_change();
    for (struct hal_comp *c = halp_first(HAL_KIND_COMP), *next; c; c = next) {
        next = halp_next(c);
        if (c->type == HAL_COMP_TYPE_REALTIME) {
            int comp_id = c->comp_id;
            halp_comp_remove(c);
            rtapi_exit(comp_id);
        }
    }
    hal_data->realtime_type = REALTIME_TYPE_UNINITIALIZED;
    memset(&hal_data->host, 0, sizeof hal_data->host);
    halp_unlock();
    int id = halp_lib_module_id;
    halp_lib_module_id = -1;
    halp_unmap(id);
    rtapi_exit(id);
}

EXPORT_SYMBOL(hal_shmem_base);
EXPORT_SYMBOL(hal_is_init);
EXPORT_SYMBOL(hal_init);
EXPORT_SYMBOL(hal_exit);
EXPORT_SYMBOL(hal_ready);
EXPORT_SYMBOL(hal_set_unready);
EXPORT_SYMBOL(hal_comp_name);
EXPORT_SYMBOL(hal_get_realtime_type);
EXPORT_SYMBOL(hal_strerror);
EXPORT_SYMBOL(hal_malloc);
EXPORT_SYMBOL(hal_reference_map);
EXPORT_SYMBOL(hal_reference_unmap);
EXPORT_SYMBOL(hal_set_constructor);
EXPORT_SYMBOL(hal_comp_invoke_make);

EXPORT_SYMBOL(hal_pin_new);
EXPORT_SYMBOL(hal_pin_bit_new);
EXPORT_SYMBOL(hal_pin_float_new);
EXPORT_SYMBOL(hal_pin_u32_new);
EXPORT_SYMBOL(hal_pin_s32_new);
EXPORT_SYMBOL(hal_pin_u64_new);
EXPORT_SYMBOL(hal_pin_s64_new);
EXPORT_SYMBOL(hal_pin_port_new);
EXPORT_SYMBOL(hal_pin_bit_newf);
EXPORT_SYMBOL(hal_pin_float_newf);
EXPORT_SYMBOL(hal_pin_u32_newf);
EXPORT_SYMBOL(hal_pin_s32_newf);
EXPORT_SYMBOL(hal_pin_u64_newf);
EXPORT_SYMBOL(hal_pin_s64_newf);
EXPORT_SYMBOL(hal_pin_port_newf);
EXPORT_SYMBOL(hal_pin_new_bool);
EXPORT_SYMBOL(hal_pin_new_si32);
EXPORT_SYMBOL(hal_pin_new_ui32);
EXPORT_SYMBOL(hal_pin_new_sint);
EXPORT_SYMBOL(hal_pin_new_uint);
EXPORT_SYMBOL(hal_pin_new_real);
EXPORT_SYMBOL(hal_pin_new_port);
EXPORT_SYMBOL(hal_pin_alias);

EXPORT_SYMBOL(hal_param_new);
EXPORT_SYMBOL(hal_param_bit_new);
EXPORT_SYMBOL(hal_param_float_new);
EXPORT_SYMBOL(hal_param_u32_new);
EXPORT_SYMBOL(hal_param_s32_new);
EXPORT_SYMBOL(hal_param_u64_new);
EXPORT_SYMBOL(hal_param_s64_new);
EXPORT_SYMBOL(hal_param_bit_newf);
EXPORT_SYMBOL(hal_param_float_newf);
EXPORT_SYMBOL(hal_param_u32_newf);
EXPORT_SYMBOL(hal_param_s32_newf);
EXPORT_SYMBOL(hal_param_u64_newf);
EXPORT_SYMBOL(hal_param_s64_newf);
EXPORT_SYMBOL(hal_param_new_bool);
EXPORT_SYMBOL(hal_param_new_si32);
EXPORT_SYMBOL(hal_param_new_ui32);
EXPORT_SYMBOL(hal_param_new_sint);
EXPORT_SYMBOL(hal_param_new_uint);
EXPORT_SYMBOL(hal_param_new_real);
EXPORT_SYMBOL(hal_param_new_fake);
EXPORT_SYMBOL(hal_param_bit_set);
EXPORT_SYMBOL(hal_param_float_set);
EXPORT_SYMBOL(hal_param_u32_set);
EXPORT_SYMBOL(hal_param_s32_set);
EXPORT_SYMBOL(hal_param_u64_set);
EXPORT_SYMBOL(hal_param_s64_set);
EXPORT_SYMBOL(hal_param_set);
EXPORT_SYMBOL(hal_param_alias);

EXPORT_SYMBOL(hal_signal_new);
EXPORT_SYMBOL(hal_signal_delete);
EXPORT_SYMBOL(hal_link);
EXPORT_SYMBOL(hal_unlink);

EXPORT_SYMBOL(hal_export_funct);
EXPORT_SYMBOL(hal_export_functf);
EXPORT_SYMBOL(hal_create_thread);
EXPORT_SYMBOL(hal_thread_delete);
EXPORT_SYMBOL(hal_add_funct_to_thread);
EXPORT_SYMBOL(hal_init_funct_to_thread);
EXPORT_SYMBOL(hal_del_funct_from_thread);
EXPORT_SYMBOL(hal_start_threads);
EXPORT_SYMBOL(hal_stop_threads);

EXPORT_SYMBOL(hal_port_read);
EXPORT_SYMBOL(hal_port_peek);
EXPORT_SYMBOL(hal_port_peek_commit);
EXPORT_SYMBOL(hal_port_write);
EXPORT_SYMBOL(hal_port_readable);
EXPORT_SYMBOL(hal_port_writable);
EXPORT_SYMBOL(hal_port_buffer_size);
EXPORT_SYMBOL(hal_port_clear);

EXPORT_SYMBOL(hal_stream_create);
EXPORT_SYMBOL(hal_stream_destroy);
EXPORT_SYMBOL(hal_stream_attach);
EXPORT_SYMBOL(hal_stream_detach);
EXPORT_SYMBOL(hal_stream_element_count);
EXPORT_SYMBOL(hal_stream_element_type);
EXPORT_SYMBOL(hal_stream_read);
EXPORT_SYMBOL(hal_stream_write);
EXPORT_SYMBOL(hal_stream_readable);
EXPORT_SYMBOL(hal_stream_writable);
EXPORT_SYMBOL(hal_stream_depth);
EXPORT_SYMBOL(hal_stream_maxdepth);
EXPORT_SYMBOL(hal_stream_num_underruns);
EXPORT_SYMBOL(hal_stream_num_overruns);
