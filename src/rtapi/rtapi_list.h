/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_list.h - a doubly linked ring whose links lie in the members. [any] */
#ifndef RTAPI_LIST_H
#define RTAPI_LIST_H

#include <stddef.h>

struct rtapi_list_head {
    struct rtapi_list_head *next, *prev;
};

#define RTAPI_INIT_LIST_HEAD(ptr) \
    do { \
        (ptr)->next = (ptr); \
        (ptr)->prev = (ptr); \
    } while (0)

/* Puts item between two neighbours. */
static inline void rtapi_list_insert_between(struct rtapi_list_head *item, struct rtapi_list_head *before,
                                             struct rtapi_list_head *after)
{
    item->prev = before;
    item->next = after;
    before->next = item;
    after->prev = item;
}
static inline void rtapi_list_add(struct rtapi_list_head *item, struct rtapi_list_head *head)
{
    rtapi_list_insert_between(item, head, head->next);
}
static inline void rtapi_list_add_tail(struct rtapi_list_head *item, struct rtapi_list_head *head)
{
    rtapi_list_insert_between(item, head->prev, head);
}
static inline void rtapi_list_del(struct rtapi_list_head *item)
{
    item->prev->next = item->next;
    item->next->prev = item->prev;
    item->next = NULL;
    item->prev = NULL;
}

#define rtapi_list_for_each(pos, head) for ((pos) = (head)->next; (pos) != (head); (pos) = (pos)->next)
#define rtapi_container_of(ptr, type, member) ((type *)((char *)(ptr) - offsetof(type, member)))
#define rtapi_list_entry(ptr, type, member) rtapi_container_of(ptr, type, member)

#endif
