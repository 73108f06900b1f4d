/// Tables in files, for keys that take them. Private to src/case/.
#ifndef SCREE_CASE_CSV_H
#define SCREE_CASE_CSV_H

#include "case/problems.h"
#include "module/key.h"

enum { SCREE_TABLE_ROWS = 2000 }; ///< most rows of a table, in the case or in a file

/// Whether the value names such a file.
bool scree_csv_is_named(const scree_node *node);

/// Puts the rows of the file that `node` names into its place: a list of lists of texts, each with its line and column
/// in the file, so that messages point there and a written case holds the table itself. The file lies beside the case
/// file unless its path is absolute. Cells are separated by commas or semicolons; what follows a '#' and empty lines do
/// not count. A first row that does not begin with a number names the columns, with units that hold for plain numbers
/// below: "time [s], velocity [mm/s]". Of a list: rows become elements of a list with these keys, which the
/// names of the columns, that must be there, are; where a cell is empty the element does not have the key. Of pairs that
/// have names (`columns`): the first row, if it names the columns, names both, in any order; of schedules it names one
/// `time`, anywhere. False: a problem has been noted.
bool scree_csv_expand(scree_reader *reader, scree_node *node, const char *path, const scree_key *key);

#endif
