#error "The component 'logging_rosout' is not selected: add `components: [+logging_rosout]` to microros.yaml and generate again"
