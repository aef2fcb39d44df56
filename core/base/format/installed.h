/* Folders of the files that are installed with the program and the libraries. */
#ifndef JOX_BASE_FORMAT_INSTALLED_H
#define JOX_BASE_FORMAT_INSTALLED_H

/* Returns the folder with scripts/, behaviours/ and scenes/: DATADIR of the build. If that is
   relative, it is relative to the folder of the program or shared library that contains this code,
   so that an installation can be moved. The text stays valid; any thread may ask. */
const char *jox_data_folder(void);
/* Returns the folder of the live page, PAGEDIR of the build, in the same way. */
const char *jox_page_folder(void);

#endif
