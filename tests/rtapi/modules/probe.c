/* SPDX-License-Identifier: GPL-2.0-or-later
 * A module with parameters of every kind; prints them when it starts. */
#include "rtapi.h"
#include "rtapi_app.h"

MODULE_LICENSE("GPL");
int number = 7;
RTAPI_MP_INT(number, "an int");
long big = 8;
RTAPI_MP_LONG(big, "a long");
char *text = "none";
RTAPI_MP_STRING(text, "a string");
int numbers[3] = {1, 2, 3};
RTAPI_MP_ARRAY_INT(numbers, 3, "ints");
char *texts[2] = {"a", "b"};
RTAPI_MP_ARRAY_STRING(texts, 2, "strings");
long odd = 1;
MODULE_PARM(odd, "x");
int untyped = 1;
void *rtapi_info_address_untyped = &untyped;
int result = 0;
RTAPI_MP_INT(result, "what rtapi_app_main returns");

int rtapi_app_main(void)
{
    rtapi_print("number %d big %ld text <%s> numbers %d %d %d texts <%s> <%s>\n", number, big, text, numbers[0],
                numbers[1], numbers[2], texts[0], texts[1]);
    return result;
}

void rtapi_app_exit(void)
{
    rtapi_print("probe ends\n");
}
