#error "The component 'logging_rosout' is not in this version yet"
