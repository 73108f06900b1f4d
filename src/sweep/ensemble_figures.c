/// Figures of ensembles, copied beside the page that shows them.
#include "sweep/ensemble_figures.h"
#include "sweep/ensemble.h"

#include "io/run_directory.h"

#include <string.h>
#include <unistd.h>

/// A figure of a point, if it has it.
static scree_status put_figure(const scree_finding *f, const char *figure, bool usual, const char *folder,
                               const char *link, FILE *page, scree_error *error)
{
    char from[PATH_MAX], to[PATH_MAX], name[128], file[480];
    const char *point = f->label[0] ? f->label : "all";
    (void)snprintf(name, sizeof name, "%s.png", figure);
    scree_status status = scree_path_join(from, sizeof from, f->ensemble, name, error);
    if (status || access(from, R_OK) != 0) return status;
    (void)snprintf(file, sizeof file, "%s-%s-%s%s%s.png", f->name, point, scree_finding_form_names[f->form],
                   usual ? "" : "-", usual ? "" : figure);
    status = scree_folders_make(folder, error);
    if (!status) status = scree_path_join(to, sizeof to, folder, file, error);
    if (!status) status = scree_file_copy(from, to, error);
    if (status) return status;
    (void)fprintf(page, "\n![%s %s, %s form](%s/%s)\n\n*%s %s, %s form: ", f->name, point,
                  scree_finding_form_names[f->form], link, file, f->name, point, scree_finding_form_names[f->form]);
    const size_t runs = scree_ensemble_runs(f->ensemble);
    if (strcmp(figure, "chains") == 0 || runs == 1)
        (void)fprintf(page, "%s run.*\n", runs == 1 ? "one" : "the first");
    else
        (void)fprintf(page, "mean of %zu runs with bands of 95 %%.*\n", runs);
    return status;
}

/// Those that the sweep names, else the pressure by height.
static scree_status put_figures(const scree_finding *f, const char *folder, const char *link, FILE *page,
                                scree_error *error)
{
    char path[PATH_MAX], names[400] = SCREE_ENSEMBLE_USUAL;
    scree_status status = scree_path_join(path, sizeof path, f->ensemble, SCREE_ENSEMBLE_FIGURES, error);
    FILE *list = status ? NULL : fopen(path, "re");
    if (list && !fgets(names, (int)sizeof names, list)) (void)snprintf(names, sizeof names, SCREE_ENSEMBLE_USUAL);
    if (list) (void)fclose(list);
    names[strcspn(names, "\n")] = 0;
    char *rest = NULL;
    for (char *name = strtok_r(names, ", ", &rest); name && !status; name = strtok_r(NULL, ", ", &rest))
        status = put_figure(f, name, strcmp(name, SCREE_ENSEMBLE_USUAL) == 0, folder, link, page, error);
    return status;
}

scree_status scree_ensemble_figures_write(const scree_findings *findings, const char *name, const char *folder,
                                          const char *link, FILE *page, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < findings->count && folder && !status; i++) {
        const scree_finding *f = &findings->item[i];
        bool first = f->ensemble[0] && strcmp(f->name, name) == 0;
        for (size_t k = 0; k < i && first; k++) first = strcmp(findings->item[k].ensemble, f->ensemble) != 0;
        if (first) status = put_figures(f, folder, link, page, error);
    }
    return status;
}
