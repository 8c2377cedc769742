/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_db25.h - the 17 pins of a 26-pin connector p as they come out on a DB25, for tables of names.
 */
#ifndef HM2_DB25_H
#define HM2_DB25_H

#define DB25(p) \
    p "-01/DB25-01", p "-02/DB25-14", p "-03/DB25-02", p "-04/DB25-15", p "-05/DB25-03", p "-06/DB25-16", \
    p "-07/DB25-04", p "-08/DB25-17", p "-09/DB25-05", p "-11/DB25-06", p "-13/DB25-07", p "-15/DB25-08", \
    p "-17/DB25-09", p "-19/DB25-10", p "-21/DB25-11", p "-23/DB25-12", p "-25/DB25-13"

#endif
